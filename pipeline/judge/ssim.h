// Structural similarity. Source: Wang, Bovik, Sheikh, Simoncelli 2004, 'Image Quality Assessment: From Error
// Visibility to Structural Similarity'.
#pragma once

#include "pipeline/image_buffer.h"

namespace edgewise::judge {

inline constexpr double kSsimSigma = 1.5;  ///< px
inline constexpr int kSsimRadius = 5;      ///< px: the window is 11 x 11

/// Mean SSIM of two pictures of the same size, 1 if they are alike, never more. On the sRGB picture: R, G, B
/// clamped to [0, 1] and sRGB-encoded in double, not rounded to 8 bits; each by itself, then averaged.
///     SSIM = (2 m_x m_y + C1)(2 s_xy + C2) / ((m_x^2 + m_y^2 + C1)(s_x^2 + s_y^2 + C2))     (13) of the
///     paper
/// with Gaussian windows of population moments, data range 1, C1 = 0.01^2, C2 = 0.03^2, averaged over the
/// pixels whose window lies in the picture; where a picture is less than 11 wide (high), along that axis over
/// all pixels, the border going on beyond it. This is scikit-image's structural_similarity(data_range=1,
/// gaussian_weights=True, sigma=1.5, use_sample_covariance=False, channel_axis=-1).
/// The values must be finite.
double ssim(const ImageBuffer& image, const ImageBuffer& reference);

}  // namespace edgewise::judge
