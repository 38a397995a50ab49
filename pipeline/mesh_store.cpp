#include "pipeline/mesh_store.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "pipeline/atomic_file.h"
#include "pipeline/error.h"
#include "pipeline/methods/mesh_report.h"
#include "pipeline/read_file.h"

namespace edgewise {
namespace {

/// Arrays one after the other, each with its count.
class Writer {
  public:
    template <class Value>
    void add(const std::vector<Value>& values) {
        const std::uint64_t count = values.size();
        addBytes(&count, sizeof count);
        addBytes(values.data(), count * sizeof(Value));
    }
    std::string bytes;

  private:
    void addBytes(const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }
};

class Reader {
  public:
    explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}
    template <class Value>
    void take(std::vector<Value>& values) {
        std::uint64_t count = 0;
        takeBytes(&count, sizeof count);
        if (count > (bytes_.size() - at_) / sizeof(Value)) throw FailureError("mesh", "is not whole");
        values.resize(count);
        takeBytes(values.data(), count * sizeof(Value));
    }

  private:
    void takeBytes(void* data, std::size_t size) {
        if (size > bytes_.size() - at_) throw FailureError("mesh", "is not whole");
        bytes_.copy(static_cast<char*>(data), size, at_);
        at_ += size;
    }
    std::string bytes_;
    std::size_t at_ = 0;
};

}  // namespace

std::filesystem::path MeshStore::fileOf(const MeshChoice& choice) const {
    return folder_ / fmt::format("{}-{}.mesh", choice.mesher, choice.error_px);
}

std::optional<FilmPolygons> MeshStore::find(const MeshChoice& choice) const try {
    Reader reader(readText(fileOf(choice)));
    FilmPolygons found;
    std::vector<char> report;
    reader.take(report), reader.take(found.mesh.position_world), reader.take(found.mesh.triangles);
    reader.take(found.mesh.normal_world), reader.take(found.mesh.color);
    found.report = meshFromJson(nlohmann::json::parse(report)).value();
    return found;
} catch (const std::exception&) {
    return std::nullopt;
}

void MeshStore::keep(const MeshChoice& choice, const FilmPolygons& polygons) const try {
    const std::string report = meshJson(polygons.report).dump();
    Writer writer;
    writer.add(std::vector<char>(report.begin(), report.end()));
    writer.add(polygons.mesh.position_world), writer.add(polygons.mesh.triangles);
    writer.add(polygons.mesh.normal_world), writer.add(polygons.mesh.color);
    writeAtomically(fileOf(choice), writer.bytes);
} catch (const InputError&) {
} catch (const FailureError&) {
}

}  // namespace edgewise
