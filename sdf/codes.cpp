#include <array>
#include <type_traits>

#include "sdf/formulas.h"
#include "sdf/tape.h"

namespace edgewise::sdf {
namespace {

/// The letters of a function's arguments after its first `skip`.
template <class T>
constexpr char letterOf() {
    return std::is_same_v<T, double> ? 'r' : 'v';
}
template <auto kFunction>
struct Signature;
template <class Result, class... Arguments, Result (*kFunction)(Arguments...)>
struct Signature<kFunction> {
    static constexpr std::array<char, sizeof...(Arguments)> kLetters{letterOf<Arguments>()...};
    static constexpr std::string_view numbersAfter(std::size_t skip) {
        return std::string_view(kLetters.data(), kLetters.size()).substr(skip);
    }
};

using F = Formulas<double>;

const std::array kInfos{
#define EDGEWISE_ONE(name, form, skip) \
    CodeInfo{#name, CodeForm::form, Signature<&F::name>::numbersAfter(skip)},
#define EDGEWISE_SHAPE(name) EDGEWISE_ONE(name, kShape, 1)
#define EDGEWISE_MOVE(name) EDGEWISE_ONE(name, kMove, 1)
#define EDGEWISE_VALUE(name) EDGEWISE_ONE(name, kValue, 1)
#define EDGEWISE_VALUE_AT(name) EDGEWISE_ONE(name, kValueAt, 2)
#define EDGEWISE_PAIR(name) EDGEWISE_ONE(name, kPair, 2)
    EDGEWISE_SDF_CODES(EDGEWISE_SHAPE, EDGEWISE_MOVE, EDGEWISE_VALUE, EDGEWISE_VALUE_AT, EDGEWISE_PAIR)
#undef EDGEWISE_SHAPE
#undef EDGEWISE_MOVE
#undef EDGEWISE_VALUE
#undef EDGEWISE_VALUE_AT
#undef EDGEWISE_PAIR
#undef EDGEWISE_ONE
        CodeInfo{"keep", CodeForm::kKeep, ""},
};

}  // namespace

int CodeInfo::numberCount() const {
    int count = 0;
    for (const char letter : numbers) count += letter == 'v' ? 3 : 1;
    return count;
}

const CodeInfo& codeInfo(Code code) {
    return kInfos[static_cast<std::size_t>(code)];
}

}  // namespace edgewise::sdf
