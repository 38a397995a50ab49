#include "sdf/glsl_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <set>

#include "sdf/shared_functions.h"
#include "sdf/tape_batches.h"

namespace edgewise::sdf {
namespace {

enum class Purpose { kValue, kWinner, kLists };

/// A fold as a union of signs times values: max(a, b) = -min(-a, -b), max(a, -b) = -min(-a, b).
struct FoldSigns {
    int whole = 1, child = 1;
};
FoldSigns signsOf(Code fold) {
    switch (fold) {
        case Code::unite:
        case Code::smoothUnite:
            return {1, 1};
        case Code::intersect:
        case Code::smoothIntersect:
            return {-1, -1};
        default:
            return {-1, 1};
    }
}

/// Which of a pair gives the value: as secondWins of evaluate.cpp.
std::string secondWins(Code code, int to, int b) {
    const FoldSigns sign = signsOf(code);
    if (sign.whole > 0) return fmt::format("v{} < v{}", b, to);
    return fmt::format("v{} < {}v{}", to, sign.child > 0 ? "-" : "", b);
}

/// What a row of a batch has for each number of its block: the same for all rows, or a column of the table.
struct RowLayout {
    std::vector<int> column;  ///< by number of the block; -1: alike in all rows
    int columns = 0;
    bool own_material = false;
};

class Emitter {
  public:
    Emitter(const Tape& tape, const BatchRule& rule) : tape_(tape), batches_(findBatches(tape, rule)) {
        for (const TapeBatch& batch : batches_) layOut(batch);
    }

    GlslField run() {
        std::set<std::string> used;
        for (const Instruction& i : tape_.instructions)
            if (i.code != Code::keep) used.insert(std::string(codeInfo(i.code).name));
        field_.functions.assign(used.begin(), used.end());
        field_.text = sharedFunctions(used);
        if (!batches_.empty())
            field_.text += "float ew_number(uint word) { return uintBitsToFloat(word); }\n";
        field_.text += "float fieldAt(vec3 p) {\n" + body(Purpose::kValue) + "    return v0;\n}\n";
        field_.text += "uint winnerAt(vec3 p, out vec3 p_local) {\n" + body(Purpose::kWinner) +
                       "    p_local = q0;\n    return m0;\n}\n";
        if (!batches_.empty())
            field_.prune_text =
                "float listsFor(vec3 p, float radius) {\n    float ew_size = max(abs(p.x), "
                "max(abs(p.y), abs(p.z))) + radius;\n" +
                body(Purpose::kLists) + "    return v0;\n}\n";
        return std::move(field_);
    }

  private:
    using NumberText = std::function<std::string(std::size_t number)>;

    int numbersOf(std::size_t instruction) const {
        return codeInfo(tape_.instructions[instruction].code).numberCount();
    }
    double number(std::size_t instruction, int k) const {
        return tape_.numbers[tape_.instructions[instruction].numbers + k];
    }

    void layOut(const TapeBatch& batch) {
        RowLayout layout;
        for (std::size_t k = 0; k < batch.length; ++k)
            for (int n = 0; n < numbersOf(batch.first + k); ++n) {
                bool varies = false;
                for (std::size_t row = 1; row < batch.rows; ++row)
                    varies = varies ||
                             number(batch.first + row * batch.length + k, n) != number(batch.first + k, n);
                layout.column.push_back(varies ? layout.columns++ : -1);
            }
        layouts_.push_back(layout);
        addTable(batch, layouts_.back());
    }

    void addTable(const TapeBatch& batch, RowLayout& layout) {
        const Instruction& pair = tape_.instructions[batch.first + batch.length - 1];
        GlslBatch made;
        made.fold = pair.code;
        if (codeInfo(pair.code).numberCount() > 0) made.blend = tape_.numbers[pair.numbers];
        made.rows = static_cast<std::uint32_t>(batch.rows);
        made.first = static_cast<std::uint32_t>(field_.table.size());
        made.instructions = static_cast<std::uint32_t>(batch.length);
        made.prunable = true;
        made.lipschitz = 0.0;
        std::size_t shapes = 0;
        for (std::size_t k = 0; k < batch.length; ++k)
            shapes += codeInfo(tape_.instructions[batch.first + k].code).form == CodeForm::kShape;
        for (std::size_t at = batch.first; at < batch.end(); ++at)
            layout.own_material =
                layout.own_material ||
                tape_.instructions[at].material !=
                    tape_.instructions[batch.first + (at - batch.first) % batch.length].material;
        const std::size_t words = layout.columns + (layout.own_material ? shapes : 0);
        made.stride = static_cast<std::uint32_t>((words + 3) / 4);
        for (std::size_t row = 0; row < batch.rows; ++row) addRow(batch, layout, row, made);
        field_.batches.push_back(made);
    }

    void addRow(const TapeBatch& batch, const RowLayout& layout, std::size_t row, GlslBatch& made) {
        std::vector<std::uint32_t> words, materials;
        std::size_t n = 0;
        for (std::size_t k = 0; k < batch.length; ++k) {
            const std::size_t at = batch.first + row * batch.length + k;
            for (int j = 0; j < numbersOf(at); ++j, ++n)
                if (layout.column[n] >= 0)
                    words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(number(at, j))));
            const Instruction& i = tape_.instructions[at];
            if (layout.own_material && codeInfo(i.code).form == CodeForm::kShape)
                materials.push_back(i.material);
            if (k + 1 < batch.length && codeInfo(i.code).form != CodeForm::kMove)
                made.lipschitz = std::max(made.lipschitz, i.lipschitz);
        }
        words.insert(words.end(), materials.begin(), materials.end());
        words.resize(std::size_t{made.stride} * 4);
        for (std::size_t at = 0; at < words.size(); at += 4)
            field_.table.push_back({words[at], words[at + 1], words[at + 2], words[at + 3]});
    }

    static std::string wordText(int column) {
        return fmt::format("ew_table[ew_at + {}u].{}", column / 4, "xyzw"[column % 4]);
    }

    std::string body(Purpose purpose) const {
        std::string text = "    vec3 p0 = p;\n";
        for (int i = 1; i < tape_.positions; ++i) text += fmt::format("    vec3 p{};\n", i);
        for (int i = 0; i < tape_.values; ++i) text += fmt::format("    float v{};\n", i);
        if (purpose == Purpose::kWinner)
            for (int i = 0; i < tape_.values; ++i)
                text += fmt::format("    uint m{};\n    vec3 q{};\n", i, i);
        std::size_t batch = 0;
        for (std::size_t at = 0; at < tape_.size();) {
            if (batch < batches_.size() && batches_[batch].first == at) {
                text += loop(batch, purpose);
                at = batches_[batch++].end();
                continue;
            }
            text += line(at, purpose, literals(at), materialText(at));
            ++at;
        }
        return text;
    }

    static std::string materialText(std::uint32_t material) { return fmt::format("{}u", material); }
    std::string materialText(std::size_t at) const { return materialText(tape_.instructions[at].material); }
    NumberText literals(std::size_t at) const {
        return [this, at](std::size_t n) { return glslNumber(number(at, static_cast<int>(n))); };
    }

    /// The arguments after the first ones.
    static std::string arguments(Code code, const NumberText& text) {
        std::string list;
        std::size_t n = 0;
        for (const char letter : codeInfo(code).numbers) {
            if (letter == 'v') {
                list += fmt::format(", vec3({}, {}, {})", text(n), text(n + 1), text(n + 2));
                n += 3;
            } else {
                list += ", " + text(n++);
            }
        }
        return list;
    }

    std::string line(std::size_t at, Purpose purpose, const NumberText& numbers,
                     const std::string& material) const {
        const Instruction& i = tape_.instructions[at];
        const CodeInfo& info = codeInfo(i.code);
        const std::string rest = arguments(i.code, numbers);
        const bool winner = purpose == Purpose::kWinner;
        const int to = i.to, a = i.a, b = i.b;
        switch (info.form) {
            case CodeForm::kShape:
                return fmt::format("    v{} = {}(p{}{});\n", to, info.name, a, rest) +
                       (winner ? fmt::format("    m{} = {};\n    q{} = p{};\n", to, material, to, a) : "");
            case CodeForm::kMove:
                return fmt::format("    p{} = {}(p{}{});\n", to, info.name, a, rest);
            case CodeForm::kValue:
                return fmt::format("    v{} = {}(v{}{});\n", to, info.name, to, rest);
            case CodeForm::kValueAt:
                return fmt::format("    v{} = {}(v{}, p{}{});\n", to, info.name, to, b, rest);
            case CodeForm::kKeep:
                return fmt::format("    v{} = v{};\n", to, b) +
                       (winner ? fmt::format("    m{0} = m{1};\n    q{0} = q{1};\n", to, b) : "");
            case CodeForm::kPair:
                break;
        }
        const std::string swap = winner ? fmt::format("    if ({2}) {{ m{0} = m{1}; q{0} = q{1}; }}\n", to, b,
                                                      secondWins(i.code, to, b))
                                        : "";
        return swap + fmt::format("    v{} = {}(v{}, v{}{});\n", to, info.name, to, b, rest);
    }

    std::string loop(std::size_t index, Purpose purpose) const {
        const TapeBatch& batch = batches_[index];
        const GlslBatch& made = field_.batches[index];
        const RowLayout& layout = layouts_[index];
        std::string text;
        const int to = tape_.instructions[batch.first + batch.length - 1].to;
        if (purpose == Purpose::kLists) text += ballBegin(made, to);
        text += fmt::format(
            "    ew_turns += ew_range[{0}].y - ew_range[{0}].x;\n"
            "    for (uint ew_i = ew_range[{0}].x; ew_i < ew_range[{0}].y; ++ew_i) {{\n"
            "    uint ew_row = ew_items[ew_i], ew_at = {1}u + {2}u * ew_row;\n",
            index, made.first, made.stride);
        std::size_t first_number = 0;
        int shape = 0;
        for (std::size_t k = 0; k < batch.length; ++k) {
            const std::size_t at = batch.first + k;
            const NumberText numbers = [&, at, first_number](std::size_t n) {
                const int column = layout.column[first_number + n];
                return column < 0 ? glslNumber(number(at, static_cast<int>(n)))
                                  : fmt::format("ew_number({})", wordText(column));
            };
            const bool is_shape = codeInfo(tape_.instructions[at].code).form == CodeForm::kShape;
            const std::string material =
                layout.own_material && is_shape ? wordText(layout.columns + shape) : materialText(at);
            shape += is_shape;
            if (purpose == Purpose::kLists && k + 1 == batch.length) text += ballRow(made, index, to);
            text += line(at, purpose, numbers, material);
            first_number += static_cast<std::size_t>(numbersOf(at));
        }
        return text + "    }\n";
    }

    /// The fold as a union: what it is at least and at most in the ball.
    std::string ballBegin(const GlslBatch& made, int to) const {
        return fmt::format(
            "    float ew_low{0}, ew_high{0};\n"
            "    {{ float ew_reach = {1} * radius + ew_slack(v{0}, ew_size);\n"
            "    ew_low{0} = {2}v{0} - ew_reach; ew_high{0} = {2}v{0} + ew_reach; }}\n",
            to, glslNumber(largestBound() * (1.0 + 1e-6)), signsOf(made.fold).whole > 0 ? "" : "-");
    }
    /// The largest bound of anything in the tape: what the fold's first child has is no more.
    double largestBound() const {
        double most = 0.0;
        for (const Instruction& i : tape_.instructions)
            if (codeInfo(i.code).form != CodeForm::kMove) most = std::max(most, i.lipschitz);
        return most;
    }

    /// A row changes nothing where it is k or more above the fold; where it is k or more below, nothing
    /// before it counts. k: where the blend ends.
    static std::string ballRow(const GlslBatch& made, std::size_t index, int to) {
        const std::string blend = glslNumber(made.blend * (1.0 + 1e-6));
        const auto join = [&](const char* fold, const char* row) {
            return made.blend > 0.0 ? fmt::format("ew_joined({}{}, {}, {})", fold, to, row, blend)
                                    : fmt::format("min({}{}, {})", fold, to, row);
        };
        return fmt::format(
            "    float ew_reach = {1} * radius + ew_slack(v{2}, ew_size);\n"
            "    float ew_low = {3}v{2} - ew_reach, ew_high = {3}v{2} + ew_reach;\n"
            "    if (ew_low < ew_high{0} + {4}) {{\n"
            "    if (ew_low{0} > ew_high + {4}) {{\n"
            "    ew_forget({5}u); ew_low{0} = ew_low; ew_high{0} = ew_high;\n"
            "    }} else {{ ew_low{0} = {6}; ew_high{0} = {7}; }}\n"
            "    ew_keep({5}u, ew_row);\n"
            "    }}\n",
            to, glslNumber(made.lipschitz * (1.0 + 1e-6)), to + 1, signsOf(made.fold).child > 0 ? "" : "-",
            blend, index, join("ew_low", "ew_low"), join("ew_high", "ew_high"));
    }

    const Tape& tape_;
    std::vector<TapeBatch> batches_;
    std::vector<RowLayout> layouts_;
    GlslField field_;
};

/// Roundings of a value are relative to the sizes of the positions and numbers that it is made of: 2^-16 of
/// their sum holds 256 of them.
std::string slackText(const Tape& tape) {
    double largest = 0.0;
    for (const double number : tape.numbers) largest = std::max(largest, std::abs(number));
    return fmt::format(
        "float ew_slack(float value, float size) {{ return 1.52587890625e-05 * (abs(value) + size + {}); }}\n"
        "float ew_joined(float a, float b, float k) {{ float h = max(k - abs(a - b), 0.0); return min(a, b) "
        "- "
        "h * h * (0.25 / k); }}\n",
        glslNumber(std::min(largest, 1e6)));
}

}  // namespace

std::uint32_t GlslField::rows() const {
    std::uint32_t sum = 0;
    for (const GlslBatch& batch : batches) sum += batch.rows;
    return sum;
}

GlslField glslText(const Tape& tape, const BatchRule& rule) {
    GlslField field = Emitter(tape, rule).run();
    if (!field.batches.empty()) field.prune_text = slackText(tape) + field.prune_text;
    return field;
}

std::string glslNumber(double number) {
    const float rounded = static_cast<float>(number);
    std::string text = fmt::format("{:.9g}", rounded);
    if (text.find_first_of(".e") == text.npos) text += ".0";
    return rounded < 0.0f ? "(" + text + ")" : text;
}

}  // namespace edgewise::sdf
