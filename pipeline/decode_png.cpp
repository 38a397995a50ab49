#include "pipeline/decode_png.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "pipeline/error.h"

namespace edgewise {
namespace {

/// Where libpng reads from, and what it said when it gave up.
struct Source {
    std::span<const std::uint8_t> rest;
    char message[96] = {};
};

void readBytes(png_structp png, png_bytep out, std::size_t count) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (count > source->rest.size()) png_error(png, "is cut off");
    std::copy_n(source->rest.begin(), count, out);
    source->rest = source->rest.subspan(count);
}

/// Never returns: a handler that does makes libpng print the message and go on to its own.
void giveUp(png_structp png, png_const_charp message) {
    auto* source = static_cast<Source*>(png_get_error_ptr(png));
    std::strncpy(source->message, message, sizeof source->message - 1);
    png_longjmp(png, 1);
}

void sayNothing(png_structp, png_const_charp) {}

/// Runs a step that may longjmp back here: nothing with a destructor may live in `step`.
template <class Step>
bool succeeds(png_structp png, const Step& step) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    step();
    return true;
}

class Reader {
  public:
    Reader(std::span<const std::uint8_t> bytes, const std::string& what) : source_{bytes, {}}, what_(what) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, giveUp, sayNothing);
        info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw FailureError(what, "libpng cannot be started");
        }
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    PictureSamples readHeader() {
        run([&] {
            png_set_read_fn(png_, &source_, readBytes);
            png_read_info(png_, info_);
            png_set_expand(png_);
            png_set_interlace_handling(png_);
            png_read_update_info(png_, info_);
        });
        PictureSamples pixels;
        pixels.width = static_cast<int>(png_get_image_width(png_, info_));
        pixels.height = static_cast<int>(png_get_image_height(png_, info_));
        pixels.channels = png_get_channels(png_, info_);
        pixels.largest = png_get_bit_depth(png_, info_) == 16 ? 0xffff : 0xff;
        return pixels;
    }

    std::vector<std::uint8_t> readRows(int height) {
        const std::size_t row_bytes = png_get_rowbytes(png_, info_);
        std::vector<std::uint8_t> bytes(row_bytes * static_cast<std::size_t>(height));
        std::vector<png_bytep> rows;
        for (std::size_t at = 0; at < bytes.size(); at += row_bytes) rows.push_back(bytes.data() + at);
        run([&] {
            png_read_image(png_, rows.data());
            png_read_end(png_, nullptr);
        });
        return bytes;
    }

  private:
    template <class Step>
    void run(const Step& step) {
        if (!succeeds(png_, step))
            throw InputError(what_, std::string("is a damaged PNG: ") + source_.message);
    }

    Source source_;
    const std::string& what_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace

PictureSamples decodePng(std::span<const std::uint8_t> png, const SizeCheck& check_size,
                         const std::string& what) {
    Reader reader(png, what);
    PictureSamples picture = reader.readHeader();
    check_size(static_cast<std::uint64_t>(picture.width), static_cast<std::uint64_t>(picture.height));
    const std::vector<std::uint8_t> bytes = reader.readRows(picture.height);
    if (picture.largest == 0xff) {
        picture.values.assign(bytes.begin(), bytes.end());
        return picture;
    }
    picture.values.resize(bytes.size() / 2);
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        picture.values[i] = static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
    return picture;
}

}  // namespace edgewise
