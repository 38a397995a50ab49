// Buffers, buffer views and accessors: every byte that will be read exists.
#include <filesystem>

#include "pipeline/error.h"
#include "pipeline/gltf_check.h"
#include "pipeline/gltf_document.h"
#include "pipeline/gltf_files.h"
#include "pipeline/gltf_meshopt.h"
#include "pipeline/read_file.h"

namespace edgewise {
namespace {

struct View {
    std::uint64_t offset = 0, length = 0, stride = 0;
    bool has_data = true;  ///< plain or compressed bytes
};

std::uint64_t bytesBehindUri(const GltfElement& uri, const GltfDocument& document) {
    const std::string text = uri.string();
    if (isDataUri(text)) return base64Payload(text, uri.where()).decoded_bytes;
    const std::filesystem::path path = jailedPath(document.folder, text, uri.where());
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) uri.fail(fmt::format("no such file: {}", text));
    return std::filesystem::file_size(path);
}

/// None: a placeholder for what compressed views hold.
std::optional<std::uint64_t> bytesBehindBuffer(const GltfElement& buffer, bool is_first,
                                               const GltfDocument& document) {
    if (const auto uri = buffer.find("uri")) return bytesBehindUri(*uri, document);
    if (!document.is_binary || !is_first) return std::nullopt;
    return document.binary_chunk.size();
}

/// True if it has bytes.
bool checkBuffer(const GltfElement& buffer, bool is_first, const GltfDocument& document) {
    const std::uint64_t length = buffer.need("byteLength").integer(1, kMaxFileBytes);
    const auto found = bytesBehindBuffer(buffer, is_first, document);
    if (!found) return false;
    if (*found > kMaxFileBytes)
        throw FailureError(buffer.where(), fmt::format("{} bytes, the limit is {}", *found, kMaxFileBytes));
    if (*found < length) buffer.fail(fmt::format("byteLength is {}, but there are {} bytes", length, *found));
    return true;
}

View checkView(const GltfElement& view, const GltfElement& root, const std::vector<bool>& has_data) {
    const std::size_t buffer = view.need("buffer").reference(has_data.size(), "buffers");
    View result;
    result.offset = view.integerOr("byteOffset", 0);
    result.length = view.need("byteLength").integer(1);
    if (const auto stride = view.find("byteStride")) {
        result.stride = stride->integer(4, 252);
        if (result.stride % 4 != 0) stride->fail(fmt::format("{} is not a multiple of 4", result.stride));
    }
    const std::uint64_t available = root.need("buffers").at(buffer).need("byteLength").integer();
    if (result.offset + result.length > available)
        view.fail(fmt::format("ends at byte {}, buffers[{}] has {}", result.offset + result.length, buffer,
                              available));
    checkMeshopt(view, root, has_data);
    result.has_data = has_data[buffer] || meshoptOf(view);
    return result;
}

std::uint64_t typeComponents(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    return type == "MAT3" ? 9 : 16;
}

/// Matrix columns start at multiples of 4 bytes.
std::uint64_t elementBytes(const std::string& type, std::uint64_t component) {
    const std::uint64_t bytes = componentBytes(component);
    if (type == "MAT2") return 2 * ((2 * bytes + 3) / 4 * 4);
    if (type == "MAT3") return 3 * ((3 * bytes + 3) / 4 * 4);
    return typeComponents(type) * bytes;
}

void checkRange(const GltfElement& element, const View& view, std::uint64_t offset, std::uint64_t stride,
                std::uint64_t count, std::uint64_t element_bytes, std::uint64_t component_bytes) {
    if ((view.offset + offset) % component_bytes != 0)
        element.fail(fmt::format("starts at byte {} of its buffer, not a multiple of its components' {}",
                                 view.offset + offset, component_bytes));
    if (!view.has_data) element.fail("its buffer has no uri, hence no bytes");
    // At most 2^32 + 252 * 2^32 + 64: no overflow.
    const std::uint64_t end = offset + stride * (count - 1) + element_bytes;
    if (end > view.length)
        element.fail(fmt::format("ends at byte {} of its buffer view, which has {}", end, view.length));
}

class AccessorChecker {
  public:
    AccessorChecker(const GltfElement& accessor, const std::vector<View>& views)
        : accessor_(accessor), views_(views) {}

    void check() {
        component_ = accessor_.need("componentType").integerOf({5120, 5121, 5122, 5123, 5125, 5126});
        type_ = accessor_.need("type").stringOf({"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
        count_ = accessor_.need("count").integer(1);
        if (accessor_.booleanOr("normalized", false) && component_ >= 5125)
            accessor_.fail("is normalized, but its components are not 8- or 16-bit integers");
        checkBase();
        if (const auto sparse = accessor_.find("sparse")) checkSparse(sparse->object());
    }

  private:
    void checkBase() const {
        const std::uint64_t offset = accessor_.integerOr("byteOffset", 0);
        const auto view = accessor_.referenceIf("bufferView", views_.size(), "buffer views");
        const std::uint64_t bytes = elementBytes(type_, component_);
        if (!view) return;
        const std::uint64_t stride = views_[*view].stride == 0 ? bytes : views_[*view].stride;
        if (stride < bytes)
            accessor_.fail(fmt::format("has elements of {} bytes, bufferViews[{}] a byteStride of {}", bytes,
                                       *view, stride));
        checkRange(accessor_, views_[*view], offset, stride, count_, bytes, componentBytes(component_));
    }

    void checkSparse(const GltfElement& sparse) const {
        const std::uint64_t count = sparse.need("count").integer(1);
        if (count > count_) sparse.fail(fmt::format("replaces {} of {} elements", count, count_));
        const GltfElement indices = sparse.need("indices").object();
        const std::uint64_t bytes =
            componentBytes(indices.need("componentType").integerOf({5121, 5123, 5125}));
        checkSparsePart(indices, count, bytes, bytes);
        checkSparsePart(sparse.need("values").object(), count, elementBytes(type_, component_),
                        componentBytes(component_));
    }

    void checkSparsePart(const GltfElement& part, std::uint64_t count, std::uint64_t bytes,
                         std::uint64_t component_bytes) const {
        const std::size_t view = part.need("bufferView").reference(views_.size(), "buffer views");
        checkRange(part, views_[view], part.integerOr("byteOffset", 0), bytes, count, bytes, component_bytes);
    }

    GltfElement accessor_;
    const std::vector<View>& views_;
    std::uint64_t component_ = 0, count_ = 0;
    std::string type_;
};

/// Images and Draco's pieces are read as they lie: their views may be no placeholders.
void checkPlainViews(const GltfElement& root, const std::vector<bool>& has_data) {
    const auto check = [&](const GltfElement& owner) {
        const auto view = owner.find("bufferView");
        if (!view) return;
        const GltfElement views = root.need("bufferViews").array();
        const GltfElement found = views.at(view->reference(views.size(), "buffer views"));
        if (!has_data[found.need("buffer").integer()]) owner.fail("its buffer has no uri, hence no bytes");
    };
    root.each("images", check);
}

}  // namespace

std::uint64_t componentBytes(std::uint64_t component_type) {
    if (component_type == 5120 || component_type == 5121) return 1;
    return component_type == 5122 || component_type == 5123 ? 2 : 4;
}

std::vector<bool> checkBuffers(const GltfElement& root, const GltfDocument& document) {
    std::vector<bool> has_data;
    root.each("buffers", [&](const GltfElement& buffer) {
        has_data.push_back(checkBuffer(buffer, has_data.empty(), document));
    });
    return has_data;
}

void checkData(const GltfElement& root, const GltfDocument& document) {
    const std::vector<bool> has_data = checkBuffers(root, document);
    std::vector<View> views;
    root.each("bufferViews",
              [&](const GltfElement& view) { views.push_back(checkView(view, root, has_data)); });
    checkPlainViews(root, has_data);
    root.each("accessors", [&](const GltfElement& accessor) { AccessorChecker(accessor, views).check(); });
}

}  // namespace edgewise
