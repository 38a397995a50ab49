#include "pipeline/methods/cone_x.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/methods/cell_lights.h"
#include "pipeline/methods/cell_sampling.h"
#include "pipeline/methods/cell_shading.h"
#include "pipeline/methods/over_device.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise {
namespace {

/// Rows whose cones are held at once, beside the margin.
constexpr int kRowsAtOnce = 128;
constexpr std::size_t kMargin = ConeRows::kMargin;

class ConeXTracer : public OverDevice {
  public:
    ConeXTracer(const MethodInput& in, const FieldSettings& settings, std::unique_ptr<FieldTracer> device)
        : OverDevice(std::move(device)),
          scene_(*in.scene.field),
          grid_(rayGrid(in.camera, in.film, scene_.far)),
          background_(in.options.background, 0.0),
          keep_parts_(settings.keep_parts),
          tape_(hasTree() ? loweredTree(scene_) : sdf::Tape()),
          field_(hasTree() ? std::make_unique<sdf::SceneTracer>(scene_, tape_,
                                                                sdf::trustedSettings(scene_, settings.trace))
                           : nullptr),
          sampling_(grid_, *device_, field_.get()),
          shading_(grid_, scene_, *this) {}

    FieldSamples trace(const FieldWindow& window) override {
        FieldSamples out = FieldSamples::sized(window.samples());
        out.mixed.resize(window.samples());
        for (int y = window.pixels.y0; y < window.pixels.y1;) {
            const int end = std::min((y / kRowsAtOnce + 1) * kRowsAtOnce, window.pixels.y1);
            traceRows(window, y, std::max(end, y + 1), out);
            y = std::max(end, y + 1);
        }
        return out;
    }
    /// Booked by the device.
    std::vector<glm::dvec4> shade(std::span<const sdf::TravellingRay> rays,
                                  std::span<const sdf::SurfaceHit> hits,
                                  std::vector<std::uint32_t>* sights) override {
        Stopwatch watch;
        auto colors = device_->shade(rays, hits, sights);
        shading_seconds_ += watch.lap();
        return colors;
    }
    void report(MethodResult& result) const override {
        device_->report(result);
        result.stages.insert(result.stages.end(), stages_.begin(), stages_.end());
        result.counts["pixels"] = pixels_, result.counts["pixels_doubtful"] = doubtful_;
        result.counts["pixels_complex"] = complex_, result.counts["pixels_counted"] = counted_;
        result.counts["pixels_of_light_borders"] = lights_;
        result.counts["pieces_of_several_lights"] = lit_pieces_;
        result.counts["edge_rays"] = sampling_.rays();
    }

  private:
    bool hasTree() const { return !scene_.glsl && !scene_.tree.empty(); }

    void traceRows(const FieldWindow& window, int y0, int y1, FieldSamples& out) {
        const ConeRows rows = coneRows(*device_, {window.pixels.x0, y0, window.pixels.x1, y1});
        watch_.lap();
        std::vector<EdgeCell> cells = doubtfulCells(rows, grid_.t_max);
        sampling_.divide(rows, cells);
        shading_.shade(rows, cells, shades_);
        book("edges");
        const CellLights lights(grid_, scene_, *this, rows, cells);
        lit_pieces_ += lights.averagePieces(shades_);
        std::vector<glm::dvec4> colors = blended(rows, cells, shades_, background_);
        const std::vector<std::size_t> borders = lights.divideOthers(shades_, colors);
        book("lights");
        keep(window, rows, cells, borders, colors, out);
        if (keep_parts_) keepParts(window, rows, cells, out);
        book("blend");
    }

    void book(const std::string& stage) { watch_.book(stage, stages_, std::exchange(shading_seconds_, 0.0)); }

    /// A row's pixel in the window.
    static std::size_t inWindow(const FieldWindow& window, const ConeRows& rows, std::size_t i) {
        const std::size_t x = i % rows.width() - kMargin, y = i / rows.width() - kMargin,
                          first =
                              static_cast<std::size_t>(rows.pixels.y0 + ConeRows::kMargin - window.pixels.y0);
        return (first + y) * window.stride() + x;
    }

    void keep(const FieldWindow& window, const ConeRows& rows, const std::vector<EdgeCell>& cells,
              const std::vector<std::size_t>& borders, const std::vector<glm::dvec4>& colors,
              FieldSamples& out) {
        const auto to = [&](std::size_t i) { return inWindow(window, rows, i); };
        const std::size_t height = static_cast<std::size_t>(rows.pixels.height()) - 2 * kMargin;
        tbb::parallel_for(kMargin, kMargin + height, [&](std::size_t y) {
            for (std::size_t x = kMargin; x + kMargin < rows.width(); ++x) {
                const std::size_t i = y * rows.width() + x, k = to(i);
                out.color[k] = colors[i];
                out.evaluations[k] = out.iterations[k] = rows.cones.evaluations[i];
                if (const sdf::SurfaceHit* hit = rows.hitOf(i)) out.take(k, rows.cones.rays[i].ray, *hit);
            }
        });
        pixels_ += height * (rows.width() - 2 * kMargin);
        for (const EdgeCell& cell : cells) {
            if (!rows.inside(cell.pixel)) continue;
            ++doubtful_;
            counted_ += cell.counted;
            if (cell.pieces.front().weight < 1.0) out.mixed[to(cell.pixel)] = 1, ++complex_;
        }
        for (const std::size_t i : borders) out.mixed[to(i)] = 1;
        lights_ += borders.size();
    }

    void keepParts(const FieldWindow& window, const ConeRows& rows, const std::vector<EdgeCell>& cells,
                   FieldSamples& out) const {
        for (const EdgeCell& cell : cells) {
            if (!rows.inside(cell.pixel) || !(cell.pieces.front().weight < 1.0)) continue;
            for (const CellPart& part : cell.parts) {
                const std::uint32_t shade = cell.pieces[static_cast<std::size_t>(part.piece)].shade;
                out.parts.push_back({inWindow(window, rows, cell.pixel), part.share, part.polygon_px,
                                     shade == kNoGroup ? background_ : shades_.colors[shade]});
            }
        }
    }

    const sdf::FieldScene& scene_;
    const sdf::RayGrid grid_;
    const glm::dvec4 background_;
    const bool keep_parts_;
    const sdf::Tape tape_;
    const std::unique_ptr<const sdf::SceneTracer> field_;
    CellSampling sampling_;
    const CellShading shading_;
    CellShades shades_;  ///< of the rows at hand
    Stopwatch watch_;
    std::vector<StageTime> stages_;
    double shading_seconds_ = 0.0;  ///< since the last stage was booked
    std::uint64_t pixels_ = 0, doubtful_ = 0, complex_ = 0, counted_ = 0, lights_ = 0, lit_pieces_ = 0;
};

}  // namespace

FieldTracerMaker coneXMaker(const FieldTracerMaker& make) {
    return [make](const MethodInput& in, const FieldSettings& settings) -> std::unique_ptr<FieldTracer> {
        return std::make_unique<ConeXTracer>(in, settings, make(in, settings));
    };
}

}  // namespace edgewise
