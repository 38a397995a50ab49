#include "pipeline/compare/svg_pdf.h"

#include <cairo-pdf.h>
#include <librsvg/rsvg.h>

#include <memory>

#include "pipeline/error.h"

namespace edgewise::compare {
namespace {

constexpr double kPointsPerPx = 0.75;

template <auto Release>
struct Releaser {
    template <class T>
    void operator()(T* object) const {
        Release(object);
    }
};
template <class T, auto Release>
using Owned = std::unique_ptr<T, Releaser<Release>>;

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string svgPdf(const std::string& svg, const std::string& name) {
    const auto fail = [&](const char* why) { throw FailureError(name, why); };
    const Owned<RsvgHandle, g_object_unref> handle(
        rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), nullptr));
    if (!handle) fail("its SVG cannot be read");
    gdouble width = 0, height = 0;
    if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height)) fail("its SVG has no size");
    width *= kPointsPerPx, height *= kPointsPerPx;
    std::string pdf;
    {
        const Owned<cairo_surface_t, cairo_surface_destroy> surface(
            cairo_pdf_surface_create_for_stream(append, &pdf, width, height));
        // the same command gives the same file
        cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00");
        const Owned<cairo_t, cairo_destroy> context(cairo_create(surface.get()));
        const RsvgRectangle page{0, 0, width, height};
        if (!rsvg_handle_render_document(handle.get(), context.get(), &page, nullptr))
            fail("it cannot be drawn");
        cairo_surface_finish(surface.get());
        if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) fail("it cannot be drawn");
    }
    return pdf;
}

}  // namespace edgewise::compare
