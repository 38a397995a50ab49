#include "pipeline/compare/base64.h"

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <vector>

namespace edgewise::compare {

std::string base64(std::span<const unsigned char> bytes) {
    namespace it = boost::archive::iterators;
    using Encoder = it::base64_from_binary<it::transform_width<const unsigned char*, 6, 8>>;
    std::vector<unsigned char> whole(bytes.begin(),
                                     bytes.end());  // groups of three: the encoder reads no half ones
    const std::size_t missing = (3 - whole.size() % 3) % 3;
    whole.resize(whole.size() + missing, 0);
    std::string out(Encoder(whole.data()), Encoder(whole.data() + whole.size()));
    std::fill(out.end() - static_cast<std::ptrdiff_t>(missing), out.end(), '=');
    return out;
}

}  // namespace edgewise::compare
