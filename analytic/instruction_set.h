// Which form of a text that is built for several instruction sets runs here.
#pragma once

#include <stdexcept>
#include <string>

namespace edgewise {

/// Whether this machine runs what is built for scalar, sse2, avx2 or avx512; of other names false.
bool machineRuns(const std::string& instruction_set);

/// What EDGEWISE_ISA names; empty where it is not set.
std::string forcedInstructionSet();

/// formFor(name) of the best set that it has a form for, or of the one that EDGEWISE_ISA names: throws
/// std::invalid_argument where there is none of that.
template <class FormFor>
auto bestForm(const FormFor& formFor) {
    if (const std::string forced = forcedInstructionSet(); !forced.empty()) {
        if (const auto form = formFor(forced.c_str())) return form;
        throw std::invalid_argument("EDGEWISE_ISA: this machine has no '" + forced + "'");
    }
    for (const char* name : {"avx512", "avx2", "sse2"})
        if (const auto form = formFor(name)) return form;
    return formFor("scalar");
}

}  // namespace edgewise
