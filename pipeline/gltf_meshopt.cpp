#include "pipeline/gltf_meshopt.h"

#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include "pipeline/gltf_ignored.h"

namespace edgewise {
namespace {

struct Compressed {
    std::size_t buffer = 0, offset = 0, length = 0, stride = 0, count = 0;
    std::string mode, filter = "NONE";

    explicit Compressed(const GltfElement& from)
        : buffer(static_cast<std::size_t>(from.need("buffer").integer())),
          offset(static_cast<std::size_t>(from.integerOr("byteOffset", 0))),
          length(static_cast<std::size_t>(from.need("byteLength").integer())),
          stride(static_cast<std::size_t>(from.need("byteStride").integer())),
          count(static_cast<std::size_t>(from.need("count").integer())),
          mode(from.need("mode").string()) {
        if (const auto name = from.find("filter")) filter = name->string();
    }

    bool isAttributes() const { return mode == "ATTRIBUTES"; }
    std::size_t bytes() const { return stride * count; }

    /// What the bitstreams spend at least: attributes a header byte for 4 groups of 16 elements, of each of
    /// their bytes; triangles and indices a byte each.
    std::size_t leastLength() const {
        if (isAttributes()) return (count + 63) / 64 * stride;
        return mode == "TRIANGLES" ? count / 3 : count;
    }
};

void checkRules(const GltfElement& from, const Compressed& c) {
    if (c.isAttributes() && (c.stride == 0 || c.stride % 4 != 0 || c.stride > 256))
        from.fail(fmt::format("byteStride {} is not a multiple of 4 up to 256", c.stride));
    if (!c.isAttributes() && c.stride != 2 && c.stride != 4)
        from.fail(fmt::format("byteStride {} is neither 2 nor 4", c.stride));
    if (c.mode == "TRIANGLES" && c.count % 3 != 0)
        from.fail(fmt::format("count {} is not a multiple of 3", c.count));
    if (!c.isAttributes() && c.filter != "NONE") from.fail("a filter needs the mode ATTRIBUTES");
    if ((c.filter == "OCTAHEDRAL" && c.stride != 4 && c.stride != 8) ||
        (c.filter == "QUATERNION" && c.stride != 8))
        from.fail(fmt::format("byteStride {} does not fit the filter {}", c.stride, c.filter));
}

bool decode(const Compressed& c, const unsigned char* bytes, std::vector<unsigned char>& out) {
    out.resize(c.bytes());
    if (c.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(out.data(), c.count, c.stride, bytes, c.length) == 0;
    if (c.mode == "INDICES")
        return meshopt_decodeIndexSequence(out.data(), c.count, c.stride, bytes, c.length) == 0;
    if (meshopt_decodeVertexBuffer(out.data(), c.count, c.stride, bytes, c.length) != 0) return false;
    if (c.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), c.count, c.stride);
    if (c.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), c.count, c.stride);
    if (c.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), c.count, c.stride);
    return c.filter != "COLOR";  // KHR_meshopt_compression's, which the library does not know
}

}  // namespace

std::optional<GltfElement> meshoptOf(const GltfElement& view) {
    auto found = view.extension("EXT_meshopt_compression");
    return found ? found : view.extension("KHR_meshopt_compression");
}

void checkMeshopt(const GltfElement& view, const GltfElement& root, const std::vector<bool>& has_data) {
    const auto from = meshoptOf(view);
    if (!from) return;
    const std::size_t buffer = from->need("buffer").reference(has_data.size(), "buffers");
    from->need("mode").stringOf({"ATTRIBUTES", "TRIANGLES", "INDICES"});
    if (const auto filter = from->find("filter"))
        filter->stringOf({"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"});
    const Compressed c(*from);
    checkRules(*from, c);
    if (view.integerOr("byteStride", c.stride) != c.stride)
        from->fail(fmt::format("byteStride {} is not the buffer view's", c.stride));
    if (view.need("byteLength").integer() != c.bytes())
        from->fail(fmt::format("{} times {} bytes are not the buffer view's byteLength", c.count, c.stride));
    const std::uint64_t available = root.need("buffers").at(buffer).need("byteLength").integer();
    if (!has_data[buffer]) from->fail(fmt::format("buffers[{}] has no data", buffer));
    if (c.offset + c.length > available)
        from->fail(
            fmt::format("ends at byte {}, buffers[{}] has {}", c.offset + c.length, buffer, available));
    if (c.length < c.leastLength())
        from->fail(fmt::format("byteLength {} is too short for {} elements", c.length, c.count));
}

void unpackMeshopt(const GltfElement& root, const std::vector<bool>& has_data, tinygltf::Model& model,
                   Scene& scene) {
    std::size_t index = 0;
    root.each("bufferViews", [&](const GltfElement& view) {
        tinygltf::BufferView& target = model.bufferViews[index++];
        const auto from = meshoptOf(view);
        if (!from) return;
        const Compressed c(*from);
        tinygltf::Buffer plain;
        if (!decode(c, model.buffers[c.buffer].data.data() + c.offset, plain.data)) {
            if (!has_data[static_cast<std::size_t>(target.buffer)]) from->fail("its bytes cannot be decoded");
            return countIgnored(
                scene, "compressed buffer views that cannot be decoded (their plain bytes are used)");
        }
        target.buffer = static_cast<int>(model.buffers.size());
        target.byteOffset = 0;
        model.buffers.push_back(std::move(plain));
    });
}

}  // namespace edgewise
