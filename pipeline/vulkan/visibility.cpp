#include "pipeline/vulkan/visibility.h"

#include <algorithm>
#include <chrono>

#include "pipeline/merge_map.h"
#include "pipeline/vulkan/layouts.h"

namespace edgewise::vulkan {
namespace {

#include "shaders/shared/visibility_layouts.glsl"

static_assert(kVisBindings == kMostBindings);

constexpr std::uint32_t kGroup = 64;
constexpr std::size_t kLeafBatch = 512;  ///< leaves that have buffers at one time

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<std::uint32_t> seeThroughBits(const ScreenScene& scene) {
    std::vector<std::uint32_t> bits(scene.see_through.size() / 32 + 1, 0);
    for (std::size_t i = 0; i < scene.see_through.size(); ++i)
        if (scene.see_through[i] != 0) bits[i / 32] |= 1u << (i % 32);
    return bits;
}

FinePoint pointFrom(const double (&p)[4]) {
    return {{p[0], p[1]}, {p[2], p[3]}};
}

SegmentPiece pieceFrom(const GpuPiece& p) {
    return {(static_cast<std::uint64_t>(p.key_high) << 32) | p.key_low,
            {p.line_i, p.line_j},
            p.left,
            p.right,
            pointFrom(p.a),
            pointFrom(p.b)};
}

/// Of the sheet's scratch memory, what one cell needs.
std::size_t tableNeed(std::size_t count) {
    std::size_t room = 16;
    while (room < 3 * count) room *= 2;
    return room;
}
std::size_t crossingsNeed(std::size_t count) {
    return 4 * count + 96;
}

/// How many items of this many bytes one binding may hold.
std::size_t most(const Device& device, std::size_t bytes) {
    return device.traits().max_storage_bytes / bytes;
}

}  // namespace

class VisibilityPasses::Work {
  public:
    explicit Work(const Device& device);

    void run(const Buffer& triangles, const Buffer& planes, const Buffer& offsets, const Buffer& ids,
             const VisibilityInput& input);
    void upload(const PassGraph& graph, const MapResources& out) const;

    VisibilityReport report;
    VisibleMap map;

  private:
    struct Rooms {
        std::size_t cells, kept, pieces, rows;
    };
    bool attempt(const VisibilityInput& input, const Rooms& rooms);
    void makeBuffers(const VisibilityInput& input, const Rooms& rooms);
    bool overflows() const;
    Rooms larger(const Rooms& rooms) const;
    void level(std::uint32_t first, std::uint32_t count, bool roots);
    void sheets(std::uint32_t first, std::uint32_t count);
    void sweepLeaves(std::uint32_t first, std::uint32_t count, bool exact);
    void handBackBatch(std::uint32_t begin, std::uint32_t size);
    void handBack(const VisibilityInput& input, CellOutput& out);
    void merge(const VisibilityInput& input, CellOutput& out);
    template <class Record>
    void submit(Record&& record);
    void dispatch(const vk::raii::CommandBuffer& commands, ComputePass& pass, std::uint32_t first,
                  std::uint32_t count, std::uint32_t group);
    /// The host's copy: the device has it while a submission runs.
    GpuVisibilityStatus& status() { return state_; }
    const GpuVisibilityStatus& status() const { return state_; }
    Buffer& grown(std::optional<Buffer>& buffer, const char* name, std::size_t bytes);

    const Device& device_;
    ComputePass roots_, collect_roots_, collect_parts_, sheet_, big_sheet_, split_;
    ComputePass lines_, depth_lines_, crossings_, keys_, sweep_, exact_sweep_;
    VisibilityPush push_{};
    GpuVisibilityStatus state_{};
    std::vector<ComputePass::Range> bindings_;
    const Buffer *triangles_ = nullptr, *planes_ = nullptr, *offsets_ = nullptr, *ids_ = nullptr;
    std::optional<Buffer> see_through_, cells_, kept_, leaf_cells_, status_, pieces_, rows_, handed_, table_,
        crossing_list_, leaves_, leaf_lines_, horizontals_, tracks_, events_, key_list_, items_,
        local_planes_, words_;
};

VisibilityPasses::Work::Work(const Device& device)
    : device_(device),
      roots_(device, "visibility_roots.comp", kVisBindings, sizeof(VisibilityPush)),
      collect_roots_(device, "visibility_collect.comp", kVisBindings, sizeof(VisibilityPush), {kGroup, 1}),
      collect_parts_(device, "visibility_collect.comp", kVisBindings, sizeof(VisibilityPush), {kGroup, 0}),
      sheet_(device, "visibility_sheet.comp", kVisBindings, sizeof(VisibilityPush), {kGroup}),
      big_sheet_(device, "visibility_sheet.comp", kVisBindings, sizeof(VisibilityPush), {1}),
      split_(device, "visibility_split.comp", kVisBindings, sizeof(VisibilityPush)),
      lines_(device, "visibility_lines.comp", kVisBindings, sizeof(VisibilityPush)),
      depth_lines_(device, "visibility_depth_lines.comp", kVisBindings, sizeof(VisibilityPush)),
      crossings_(device, "visibility_crossings.comp", kVisBindings, sizeof(VisibilityPush)),
      keys_(device, "visibility_keys.comp", kVisBindings, sizeof(VisibilityPush)),
      sweep_(device, "visibility_sweep.comp", kVisBindings, sizeof(VisibilityPush), {kGroup, 0}),
      exact_sweep_(device, "visibility_sweep.comp", kVisBindings, sizeof(VisibilityPush), {1, 1}) {}

Buffer& VisibilityPasses::Work::grown(std::optional<Buffer>& buffer, const char* name, std::size_t bytes) {
    if (!buffer || buffer->bytes() < bytes) {
        buffer.reset();
        buffer.emplace(device_, name, bytes);
    }
    return *buffer;
}

void VisibilityPasses::Work::makeBuffers(const VisibilityInput& input, const Rooms& rooms) {
    const std::vector<std::uint32_t> bits = seeThroughBits(input.scene);
    std::ranges::copy(
        bits, grown(see_through_, "see-through", 4 * bits.size()).view<std::uint32_t>(bits.size()).begin());
    grown(cells_, "cells", rooms.cells * sizeof(GpuCell));
    grown(kept_, "kept", 4 * rooms.kept);
    grown(leaf_cells_, "leaf cells", 4 * 4 * rooms.cells);
    grown(status_, "visibility status", sizeof(GpuVisibilityStatus));
    grown(pieces_, "pieces", rooms.pieces * sizeof(GpuPiece));
    grown(rows_, "row pieces", rooms.rows * sizeof(GpuRowPiece));
    grown(handed_, "handed back", 4 * rooms.cells);
    grown(table_, "sheet table", 8);
    grown(crossing_list_, "row crossings", sizeof(GpuCrossing));
    grown(leaves_, "leaves", kLeafBatch * sizeof(GpuLeaf));
    grown(leaf_lines_, "leaf lines", kLeafBatch * kLeafLines * sizeof(GpuLine));
    grown(horizontals_, "horizontals", kLeafBatch * kLeafHorizontals * sizeof(GpuLine));
    grown(tracks_, "tracks", kLeafBatch * kLeafLines * sizeof(GpuTrack));
    grown(events_, "events", kLeafBatch * kLeafEvents * sizeof(GpuEvent));
    grown(key_list_, "keys", kLeafBatch * kLeafKeys * sizeof(GpuKey));
    grown(items_, "key items", kLeafBatch * kLeafKeyItems * sizeof(GpuKey));
    grown(local_planes_, "local planes", kLeafBatch * kLeafTriangles * sizeof(GpuLocalPlane));
    grown(words_, "leaf words", kLeafBatch * kLeafWords * 4);
    std::ranges::fill(leaf_cells_->view<std::uint32_t>(4 * rooms.cells), 0u);
    status() = {};
    status().cells = static_cast<std::uint32_t>(input.grid.size());
    status().cells_room = static_cast<std::uint32_t>(rooms.cells);
    status().kept_room = static_cast<std::uint32_t>(rooms.kept);
    status().pieces_room = static_cast<std::uint32_t>(rooms.pieces);
    status().rows_room = static_cast<std::uint32_t>(rooms.rows);
}

template <class Record>
void VisibilityPasses::Work::submit(Record&& record) {
    bindings_.clear();
    for (const Buffer* buffer :
         std::initializer_list<const Buffer*>{triangles_,     planes_,          offsets_,  ids_,
                                              &*see_through_, &*cells_,         &*kept_,   &*leaf_cells_,
                                              &*status_,      &*pieces_,        &*rows_,   &*handed_,
                                              &*table_,       &*crossing_list_, &*leaves_, &*leaf_lines_,
                                              &*horizontals_, &*tracks_,        &*events_, &*key_list_,
                                              &*items_,       &*local_planes_,  &*words_})
        bindings_.emplace_back(*buffer);
    status_->view<GpuVisibilityStatus>(1)[0] = state_;
    const auto start = std::chrono::steady_clock::now();
    const vk::raii::CommandBuffers lists(device_.handle(),
                                         {*device_.commandPool(), vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = lists.front();
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    record(commands);
    commands.end();
    device_.run(commands);
    state_ = status_->read<GpuVisibilityStatus>(1)[0];
    for (ComputePass* pass : {&roots_, &collect_roots_, &collect_parts_, &sheet_, &big_sheet_, &split_,
                              &lines_, &depth_lines_, &crossings_, &keys_, &sweep_, &exact_sweep_})
        pass->forgetSets();
    report.device_seconds += secondsSince(start);
}

void VisibilityPasses::Work::dispatch(const vk::raii::CommandBuffer& commands, ComputePass& pass,
                                      std::uint32_t first, std::uint32_t count, std::uint32_t group) {
    push_.first = first, push_.count = count;
    pass.dispatch(commands, bindings_, Groups::covering(count, group), push_);
    const vk::MemoryBarrier all(vk::AccessFlagBits::eMemoryWrite,
                                vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite);
    using Stage = vk::PipelineStageFlagBits;
    commands.pipelineBarrier(Stage::eAllCommands, Stage::eAllCommands | Stage::eHost, {}, all, {}, {});
    ++report.dispatches;
}

/// Cells of one size: what they keep, whether a sheet covers them, else their parts or leaves.
void VisibilityPasses::Work::level(std::uint32_t first, std::uint32_t count, bool roots) {
    submit([&](const auto& commands) {
        if (roots) dispatch(commands, roots_, 0, count, kGroup);
        dispatch(commands, roots ? collect_roots_ : collect_parts_, first, count, kGroup);
    });
    if (push_.flags & kCertify) sheets(first, count);
    submit([&](const auto& commands) { dispatch(commands, split_, first, count, kGroup); });
}

/// As many cells at a time as the scratch memory holds.
void VisibilityPasses::Work::sheets(std::uint32_t first, std::uint32_t count) {
    const std::size_t table_most = most(device_, 8), crossings_most = most(device_, sizeof(GpuCrossing));
    const auto read = cells_->read<GpuCell>(count, first * sizeof(GpuCell));
    const std::vector<GpuCell> cells(read.begin(), read.end());
    for (std::uint32_t i = first; i < first + count;) {
        const std::uint32_t begin = i;
        std::size_t table = 0, crossings = 0;
        for (; i < first + count; ++i) {
            const GpuCell& cell = cells[i - first];
            if (cell.state != kCellOpen || cell.count > push_.sheet_most) continue;
            const std::size_t t = tableNeed(cell.count), c = crossingsNeed(cell.count);
            if (i > begin && (table + t > table_most || crossings + c > crossings_most)) break;
            table += t, crossings += c;
        }
        grown(table_, "sheet table", std::max<std::size_t>(8, 8 * table));
        grown(crossing_list_, "row crossings", std::max<std::size_t>(1, crossings) * sizeof(GpuCrossing));
        status().table = status().crossings = 0;
        status().table_room = static_cast<std::uint32_t>(table);
        status().crossings_room = static_cast<std::uint32_t>(crossings);
        submit([&](const auto& commands) {
            dispatch(commands, sheet_, begin, i - begin, kGroup);
            dispatch(commands, big_sheet_, begin, i - begin, 1);
        });
    }
}

/// Leaves whose loops the device may have stopped are the host's; what it emitted of them counts for nothing.
void VisibilityPasses::Work::handBackBatch(std::uint32_t begin, std::uint32_t size) {
    const auto ids = leaf_cells_->read<std::uint32_t>(size, begin * sizeof(std::uint32_t));
    const auto leaves = leaves_->read<GpuLeaf>(size);
    const std::size_t done = (2 * std::size_t{status().cells_room} + begin) * sizeof(std::uint32_t);
    std::ranges::fill(leaf_cells_->view<std::uint32_t>(size, done), 0u);
    const auto handed = handed_->view<std::uint32_t>(status().handed + size);
    for (std::uint32_t i = 0; i < size; ++i)
        if (leaves[i].state != kLeafHanded && leaves[i].state != kLeafUndecided)
            handed[status().handed++] = ids[i];
    status().overruns = 0;
}

void VisibilityPasses::Work::sweepLeaves(std::uint32_t first, std::uint32_t count, bool exact) {
    ComputePass& sweep = exact ? exact_sweep_ : sweep_;
    const std::uint32_t group = exact ? 1 : kGroup;
    for (std::uint32_t done = 0; done < count; done += kLeafBatch) {
        const std::uint32_t begin = first + done, size = std::min<std::uint32_t>(kLeafBatch, count - done);
        status().unfinished = 0;
        submit([&](const auto& commands) {
            for (ComputePass* pass : {&lines_, &depth_lines_, &crossings_, &keys_})
                dispatch(commands, *pass, begin, size, kGroup);
            dispatch(commands, sweep, begin, size, group);
        });
        while (status().unfinished > 0 && status().overruns == 0) {
            status().unfinished = 0;
            submit([&](const auto& commands) { dispatch(commands, sweep, begin, size, group); });
        }
        if (status().overruns > 0) handBackBatch(begin, size);
    }
}

bool VisibilityPasses::Work::overflows() const {
    const GpuVisibilityStatus& s = status();
    return s.cells > s.cells_room || s.kept > s.kept_room || s.pieces > s.pieces_room || s.rows > s.rows_room;
}

/// An attempt counts as far as it went: more is to come, of all that levels fill.
VisibilityPasses::Work::Rooms VisibilityPasses::Work::larger(const Rooms& rooms) const {
    const GpuVisibilityStatus& s = status();
    const bool levels = s.cells > rooms.cells || s.kept > rooms.kept;
    const auto grow = [&](std::size_t room, std::size_t needed, bool grows, std::size_t bytes) {
        if (!grows && needed <= room) return room;
        return std::max(needed, std::min(4 * std::max(room, needed), most(device_, bytes)));
    };
    return {grow(rooms.cells, s.cells, levels, sizeof(GpuCell)),
            grow(rooms.kept, s.kept, levels, sizeof(std::uint32_t)),
            grow(rooms.pieces, s.pieces, false, sizeof(GpuPiece)),
            grow(rooms.rows, s.rows, false, sizeof(GpuRowPiece))};
}

/// False where a buffer was too small.
bool VisibilityPasses::Work::attempt(const VisibilityInput& input, const Rooms& rooms) {
    makeBuffers(input, rooms);
    const auto roots = static_cast<std::uint32_t>(input.grid.size());
    status().kept = offsets_->read<std::uint32_t>(1, roots * sizeof(std::uint32_t))[0];
    std::uint32_t first = 0, count = roots;
    while (count > 0) {
        level(first, count, first == 0);
        if (overflows()) return false;
        if (status().overruns >
            0) {  // sheets too large for the device's loops: fewer of them together, or none
            push_.sheet_most = push_.sheet_small == 0 ? push_.sheet_most / 2 : push_.sheet_most;
            push_.sheet_small = 0;
            return false;
        }
        first += count;
        count = status().cells - first;
    }
    sweepLeaves(0, status().leaves, false);
    sweepLeaves(status().cells_room, status().undecided, true);
    return !overflows();
}

/// Cells that the device could not do are done here, with the same bits.
void VisibilityPasses::Work::handBack(const VisibilityInput& input, CellOutput& out) {
    CellVisibility visibility;
    for (const std::uint32_t id : handed_->read<std::uint32_t>(status().handed)) {
        const GpuCell c = cells_->read<GpuCell>(1, id * sizeof(GpuCell))[0];
        const glm::dvec2 low(c.min_x, c.min_y);
        const bool listed = c.untouched != 0 && id < input.grid.size();
        const std::size_t begin = c.untouched != 0 ? c.source : c.begin;
        const auto list =
            (listed ? ids_ : &*kept_)->read<std::uint32_t>(c.count, begin * sizeof(std::uint32_t));
        visibility.runPart(input.scene, {low, low + c.size_px}, {c.origin_x, c.origin_y}, list, input.options,
                           out);
    }
}

void VisibilityPasses::Work::merge(const VisibilityInput& input, CellOutput& out) {
    const GpuVisibilityStatus& s = status();
    const auto done = leaf_cells_->read<std::uint32_t>(2 * std::size_t{s.cells_room},
                                                       2 * std::size_t{s.cells_room} * sizeof(std::uint32_t));
    const auto counts = [&](std::uint32_t tag) { return tag == kNoTag || done[tag] != 0; };
    out.segments.reserve(out.segments.size() + s.pieces);
    for (const GpuPiece& p : pieces_->read<GpuPiece>(s.pieces))
        if (p.left != p.right && counts(p.tag)) out.segments.push_back(pieceFrom(p));
    for (const GpuRowPiece& p : rows_->read<GpuRowPiece>(s.rows))
        if (counts(p.tag)) out.rows.push_back({p.row, p.owner, p.x_px});
    report.counts.pieces = out.segments.size();
    CellOutput* const outputs[] = {&out};
    Progress uncancelled;
    map = mergeMap(input.scene, outputs, input.grid.px.y0, input.grid.px.y1, uncancelled);
}

void VisibilityPasses::Work::run(const Buffer& triangles, const Buffer& planes, const Buffer& offsets,
                                 const Buffer& ids, const VisibilityInput& input) {
    triangles_ = &triangles, planes_ = &planes, offsets_ = &offsets, ids_ = &ids;
    const VisibilityOptions& options = input.options;
    push_ = {};
    push_.anchor_x = input.scene.anchor_px.x, push_.anchor_y = input.scene.anchor_px.y;
    push_.x0_px = input.grid.px.x0, push_.y0_px = input.grid.px.y0, push_.columns = input.grid.columns;
    push_.flags = (options.occlusion ? kDropHidden : 0) | (options.certify ? kCertify : 0) |
                  (options.every_depth_line ? kEveryDepthLine : 0) |
                  (input.scene.see_through.empty() ? 0 : kSomeSeeThrough);
    push_.max_triangles = static_cast<std::uint32_t>(options.max_triangles);
    push_.min_cell_px = options.min_cell_px;
    push_.sheet_small = device_.traits().real_gpu ? kSheetTriangles : kSheetSmall;
    push_.sheet_most = kSheetTriangles;
    push_.loop_turns = device_.traits().loop_turns;
    report = {};
    const std::size_t total = offsets.read<std::uint32_t>(1, input.grid.size() * sizeof(std::uint32_t))[0];
    const auto room = [&](std::size_t items, std::size_t bytes) {
        return std::min(items, most(device_, bytes));
    };
    Rooms rooms{room(8 * input.grid.size() + 4096, sizeof(GpuCell)),
                room(8 * total + 4096, sizeof(std::uint32_t)), room(3 * total + 8192, sizeof(GpuPiece)),
                room(8 * total + 16 * input.grid.size() + 8192, sizeof(GpuRowPiece))};
    while (!attempt(input, rooms)) rooms = larger(rooms);
    const GpuVisibilityStatus& s = status();
    report.cells = s.cells, report.leaves = s.leaves, report.exact = s.undecided, report.handed = s.handed;
    CellOutput out;
    auto start = std::chrono::steady_clock::now();
    handBack(input, out);
    report.host_seconds = secondsSince(start);
    start = std::chrono::steady_clock::now();
    VisibilityCounts& counts = report.counts;
    counts = out.counts;
    counts.cells += s.swept, counts.certified += s.certified, counts.slabs += s.slabs;
    counts.depth_lines += s.depth_lines, counts.exact_depth += s.exact_depth;
    counts.hidden += s.hidden, counts.closings += s.closings;
    merge(input, out);
    report.merge_seconds = secondsSince(start);
}

void VisibilityPasses::Work::upload(const PassGraph& graph, const MapResources& out) const {
    const auto segments = graph[out.segments].view<GpuSegment>(map.segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const VisibleSegment& s = map.segments[i];
        segments[i] = {{s.a.grid.x, s.a.grid.y},
                       {s.a.rest.x, s.a.rest.y},
                       {s.b.grid.x, s.b.grid.y},
                       {s.b.rest.x, s.b.rest.y},
                       s.length,
                       s.line,
                       s.left,
                       s.right,
                       0};
    }
    std::ranges::copy(map.lines, graph[out.lines].view<CarrierLine>(map.lines.size()).begin());
    std::ranges::copy(map.row_offset,
                      graph[out.row_offsets].view<std::uint32_t>(map.row_offset.size()).begin());
    std::ranges::copy(map.rows, graph[out.row_owners].view<RowOwner>(map.rows.size()).begin());
}

VisibilityPasses::VisibilityPasses(const Device& device) : work_(std::make_unique<Work>(device)) {}
VisibilityPasses::~VisibilityPasses() = default;

const VisibilityReport& VisibilityPasses::report() const {
    return work_->report;
}
const VisibleMap& VisibilityPasses::map() const {
    return work_->map;
}

MapResources VisibilityPasses::addTo(PassGraph& graph, Resource triangles, Resource planes, Resource offsets,
                                     Resource ids, std::function<VisibilityInput()> input) {
    Work* work = work_.get();
    const Resource swept = graph.buffer("visibility", [] { return std::size_t{1}; });
    graph.add(
        "visibility",
        {.reads = {triangles, planes, offsets, ids}, .writes = {swept}, .host = [=](const PassGraph& g) {
             work->run(g[triangles], g[planes], g[offsets], g[ids], input());
         }});
    const MapResources out{
        graph.buffer("segments", [work] { return work->map.segments.size() * sizeof(GpuSegment); }),
        graph.buffer("lines", [work] { return work->map.lines.size() * sizeof(CarrierLine); }),
        graph.buffer("row offsets", [work] { return work->map.row_offset.size() * sizeof(std::uint32_t); }),
        graph.buffer("row owners", [work] { return work->map.rows.size() * sizeof(RowOwner); })};
    graph.add("merge", {.reads = {swept},
                        .writes = {out.segments, out.lines, out.row_offsets, out.row_owners},
                        .host = [=](const PassGraph& g) { work->upload(g, out); }});
    return out;
}

}  // namespace edgewise::vulkan
