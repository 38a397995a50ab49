// A plot for papers.
#pragma once

#include <string>

namespace edgewise::compare {

/// An <svg> that has a width and a height, as PDF of one page. Throws FailureError "NAME: WHY" where it
/// cannot be made.
std::string svgPdf(const std::string& svg, const std::string& name);

}  // namespace edgewise::compare
