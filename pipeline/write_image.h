// The last stage: an image becomes an EXR or PNG file.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/image_buffer.h"
#include "pipeline/progress.h"

namespace edgewise {

struct WriteOptions {
    int width = 0, height = 0;  ///< of the whole picture; the buffer's box is the part that was made
    double exposure_ev = 0.0;   ///< PNG only: linear values are multiplied by 2^EV
    std::map<std::string, std::string> metadata;  ///< "version" -> "0.1.0"; written as "edgewise:version"
};

enum class ImageFormat { kExr, kPng };

/// The format that the extension (.exr, .png, in any case) names. Throws InputError for any other.
ImageFormat imageFormat(const std::filesystem::path& path);

/// EXR: float32 R, G, B, A and `edge`, the AOVs' channels and attributes, linear Rec.709, zip; dataWindow is
/// the box, displayWindow the whole picture. PNG: 8-bit RGB of the box: exposed, clamped to [0, 1],
/// sRGB-encoded, rounded to nearest. The same image and options give the same bytes. Throws FailureError for
/// a pixel that is not finite (in float32 for EXR), naming it.
std::vector<unsigned char> encodeImage(const ImageBuffer& image, ImageFormat format,
                                       const WriteOptions& options);

/// The same bytes straight into a file, some rows at a time, so that a picture need not be held whole. It
/// appears once it is finished, or not at all.
class ImageWriter {
  public:
    /// `box`: all that will come; `aov`: its channels and attributes, the values may be absent.
    ImageWriter(const std::filesystem::path& path, const PixelBox& box, const AovImage& aov,
                const WriteOptions& options);
    ~ImageWriter();
    ImageWriter(ImageWriter&&) noexcept;

    /// Rows of the box's full width, below the last ones. Throws Interrupted when cancelled.
    void write(const ImageBuffer& rows, Progress& progress);
    void finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// encodeImage() into a file that appears whole or not at all.
void writeImage(const std::filesystem::path& path, const ImageBuffer& image, const WriteOptions& options);

}  // namespace edgewise
