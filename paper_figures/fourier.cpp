#include "paper_figures/fourier.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>

#include "pipeline/error.h"

namespace edgewise::figures {

std::vector<double> beyondFrequency(const std::vector<double>& values, int side, double limit) {
    using namespace OIIO;
    std::vector<float> samples(values.begin(), values.end());
    const ImageBuf picture(ImageSpec(side, side, 1, TypeDesc::FLOAT), samples.data());
    ImageBuf spectrum = ImageBufAlgo::fft(picture);
    if (spectrum.has_error()) throw FailureError("Fourier transform", spectrum.geterror());
    const auto low = [&](int bin) { return std::min(bin, side - bin) <= limit * side * (1 + 1e-9); };
    for (ImageBuf::Iterator<float> bin(spectrum); !bin.done(); ++bin)
        if (low(bin.x()) && low(bin.y())) bin[0] = bin[1] = 0.0f;
    const ImageBuf high = ImageBufAlgo::ifft(spectrum);
    if (high.has_error()) throw FailureError("Fourier transform", high.geterror());
    if (!high.get_pixels(high.roi(), TypeDesc::FLOAT, samples.data()))
        throw FailureError("Fourier transform", high.geterror());
    return {samples.begin(), samples.end()};
}

}  // namespace edgewise::figures
