// The functions of shaders/shared/sdf_*.glsl as text, for shaders that are put together at run time.
#pragma once

#include <set>
#include <string>

namespace edgewise::sdf {

/// The definitions of these functions and of all that they call, in the order of the shared files, with what
/// the shared text asks of a number (real, square, less, choose) before them. Comments are left out.
std::string sharedFunctions(const std::set<std::string>& wanted);

}  // namespace edgewise::sdf
