#include "pipeline/write_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>

#include "pipeline/atomic_file.h"
#include "pipeline/error.h"
#include "pipeline/srgb.h"

namespace edgewise {
namespace {

/// x, y of red, green, blue and white of Rec.709, as OpenEXR stores them.
constexpr std::array<float, 8> kRec709{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
constexpr int kExrChannels = 5;
constexpr int kPngChannels = 3;

/// Pixel `index` of the box, for messages.
std::string pixelName(const PixelBox& box, std::size_t index) {
    const std::size_t width = static_cast<std::size_t>(box.width());
    return fmt::format("pixel {},{}", box.x0 + static_cast<int>(index % width),
                       box.y0 + static_cast<int>(index / width));
}

void requireFinite(const PixelBox& box, std::size_t index, double value) {
    if (!std::isfinite(value))
        throw FailureError(pixelName(box, index), fmt::format("is {}, not a number", value));
}

/// The bits of a row's channels: float32, and uint32 where an AOV is a whole number.
void exrRow(const ImageBuffer& image, int y, std::vector<std::uint32_t>& out) {
    const auto& channels = image.aov.channels;
    for (std::size_t i = image.index(image.box.x0, y); i < image.index(image.box.x1, y); ++i) {
        for (int c = 0; c < 4; ++c) {
            const float value = static_cast<float>(image.rgba[i][c]);
            requireFinite(image.box, i, value);
            out.push_back(floatBits(value));
        }
        out.push_back(floatBits(image.edge[i]));
        const std::uint32_t* more = image.aov.pixel(i);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            if (!channels[c].whole_number) requireFinite(image.box, i, std::bit_cast<float>(more[c]));
            out.push_back(more[c]);
        }
    }
}

void pngRow(const ImageBuffer& image, int y, double gain, std::vector<unsigned char>& out) {
    for (std::size_t i = image.index(image.box.x0, y); i < image.index(image.box.x1, y); ++i) {
        for (int c = 0; c < kPngChannels; ++c) {
            requireFinite(image.box, i, image.rgba[i][c]);
            const double encoded = encodeSrgb(std::clamp(image.rgba[i][c] * gain, 0.0, 1.0));
            out.push_back(static_cast<unsigned char>(std::floor(encoded * 255.0 + 0.5)));
        }
    }
}

void addAovs(OIIO::ImageSpec& spec, const AovImage& aov) {
    spec.channelformats.assign(kExrChannels, OIIO::TypeDesc::FLOAT);
    for (const AovChannel& channel : aov.channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(channel.whole_number ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT);
        if (channel.name == "Z") spec.z_channel = static_cast<int>(spec.channelnames.size()) - 1;
    }
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    for (const auto& [name, value] : aov.metadata) spec.attribute(name, value);
}

OIIO::ImageSpec exrSpec(const PixelBox& box, const AovImage& aov, const WriteOptions& options) {
    OIIO::ImageSpec spec(box.width(), box.height(), kExrChannels, OIIO::TypeDesc::FLOAT);
    spec.x = box.x0;
    spec.y = box.y0;
    spec.full_x = spec.full_y = 0;
    spec.full_width = options.width;
    spec.full_height = options.height;
    spec.channelnames = {"R", "G", "B", "A", "edge"};
    spec.alpha_channel = 3;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("DateTime", "");  // else OpenImageIO writes the hour, and no two files are alike
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, kRec709.size()), kRec709.data());
    if (!aov.channels.empty()) addAovs(spec, aov);
    return spec;
}

OIIO::ImageSpec pngSpec(const PixelBox& box) {
    OIIO::ImageSpec spec(box.width(), box.height(), kPngChannels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return spec;
}

void addMetadata(OIIO::ImageSpec& spec, const WriteOptions& options) {
    for (const auto& [name, value] : options.metadata) spec.attribute("edgewise:" + name, value);
}

/// Rows that are compressed at once: a multiple of what a block of either format holds.
constexpr int kRowsAtOnce = 64;

/// An OpenImageIO writer that rows are handed to from the top.
class Encoder {
  public:
    Encoder(ImageFormat format, const PixelBox& box, const AovImage& aov, const WriteOptions& options,
            OIIO::Filesystem::IOProxy& target)
        : format_(format), gain_(std::exp2(options.exposure_ev)), first_row_(box.y0) {
        OIIO::ImageSpec spec = format == ImageFormat::kExr ? exrSpec(box, aov, options) : pngSpec(box);
        addMetadata(spec, options);
        type_ = spec.channelformats.empty() ? spec.format : OIIO::TypeDesc(OIIO::TypeDesc::UNKNOWN);
        first_row_ -= spec.y;
        output_ = OIIO::ImageOutput::create(name(), &target);
        require(output_ && output_->open(std::string("picture.") + name(), spec));
    }

    void write(const ImageBuffer& image, Progress& progress) {
        for (int y = image.box.y0; y < image.box.y1; y += kRowsAtOnce) {
            if (progress.cancelled()) throw Interrupted();
            const int end = std::min(y + kRowsAtOnce, image.box.y1);
            writeRows(image, y, end);
            progress.advance(static_cast<std::size_t>(end - y));
        }
    }

    void finish() {
        require(output_->close());
        output_.reset();
    }

    /// libpng complains on standard error about a picture that is given up: black rows keep it quiet.
    ~Encoder() {
        if (!output_ || format_ != ImageFormat::kPng) return;
        const std::vector<unsigned char> row(output_->spec().scanline_bytes(), 0);
        for (; next_row_ < output_->spec().height; ++next_row_)
            output_->write_scanline(next_row_, 0, type_, row.data());
    }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

  private:
    const char* name() const { return format_ == ImageFormat::kExr ? "exr" : "png"; }

    void require(bool done) const {
        if (!done) throw FailureError(name(), output_ ? output_->geterror() : OIIO::geterror());
    }

    void writeRows(const ImageBuffer& image, int begin, int end) {
        words_.clear(), bytes_.clear();
        for (int y = begin; y < end; ++y)
            format_ == ImageFormat::kExr ? exrRow(image, y, words_) : pngRow(image, y, gain_, bytes_);
        const void* rows = format_ == ImageFormat::kExr ? static_cast<const void*>(words_.data())
                                                        : static_cast<const void*>(bytes_.data());
        next_row_ = end - first_row_;
        require(output_->write_scanlines(begin - first_row_, next_row_, 0, type_, rows));
    }

    ImageFormat format_;
    double gain_;
    int first_row_;     ///< of the film, where the file counts from 0
    int next_row_ = 0;  ///< of the file
    OIIO::TypeDesc type_;
    std::unique_ptr<OIIO::ImageOutput> output_;
    std::vector<std::uint32_t> words_;
    std::vector<unsigned char> bytes_;
};

}  // namespace

ImageFormat imageFormat(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension == ".exr") return ImageFormat::kExr;
    if (extension == ".png") return ImageFormat::kPng;
    throw InputError(path.string(), "an image's name ends in .exr or .png");
}

std::vector<unsigned char> encodeImage(const ImageBuffer& image, ImageFormat format,
                                       const WriteOptions& options) {
    Progress silent;
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput target(bytes);
    Encoder encoder(format, image.box, image.aov, options, target);
    encoder.write(image, silent);
    encoder.finish();
    return bytes;
}

struct ImageWriter::State {
    std::filesystem::path path;
    std::optional<PendingFile> file;   ///< or, where a device or a pipe cannot be sought in:
    std::vector<unsigned char> bytes;  ///< all of it
    std::unique_ptr<OIIO::Filesystem::IOProxy> target;
    std::optional<Encoder> encoder;
};

ImageWriter::ImageWriter(const std::filesystem::path& path, const PixelBox& box, const AovImage& aov,
                         const WriteOptions& options)
    : state_(std::make_unique<State>()) {
    state_->path = path;
    std::error_code ignored;
    if (std::filesystem::is_other(path, ignored)) {
        state_->target = std::make_unique<OIIO::Filesystem::IOVecOutput>(state_->bytes);
    } else {
        state_->file.emplace(path);
        state_->target = std::make_unique<OIIO::Filesystem::IOFile>(state_->file->stream(),
                                                                    OIIO::Filesystem::IOProxy::Mode::Write);
    }
    state_->encoder.emplace(imageFormat(path), box, aov, options, *state_->target);
}

ImageWriter::~ImageWriter() = default;
ImageWriter::ImageWriter(ImageWriter&&) noexcept = default;

void ImageWriter::write(const ImageBuffer& rows, Progress& progress) {
    state_->encoder->write(rows, progress);
}

void ImageWriter::finish() {
    state_->encoder->finish();
    state_->encoder.reset();
    state_->target.reset();
    if (state_->file)
        state_->file->keep();
    else
        writeAtomically(state_->path, state_->bytes);
}

void writeImage(const std::filesystem::path& path, const ImageBuffer& image, const WriteOptions& options) {
    Progress silent;
    ImageWriter writer(path, image.box, image.aov, options);
    writer.write(image, silent);
    writer.finish();
}

}  // namespace edgewise
