#include "pipeline/compare/comparison.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <climits>
#include <fstream>
#include <thread>

#include "pipeline/methods/resolved_parameters.h"

namespace edgewise::compare {

std::string nameOf(RowStatus status) {
    switch (status) {
        case RowStatus::kOk:
            return "ok";
        case RowStatus::kTimeout:
            return "timeout";
        case RowStatus::kFailed:
            return "failed";
    }
    return "";
}

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const std::size_t n = values.size();
    const double median = n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
    return {median, values.front(), values.back(), n};
}

Row rowOf(const MethodSpec& method, const Prefilter& filter) {
    Row row;
    row.method = method.typed;
    row.parameters = resolvedParameters(method);
    row.filter = filter.name, row.radius = filter.radius;
    if (filter.kind == KernelKind::kGaussian || filter.kind == KernelKind::kGaussianSeparable)
        row.sigma = filter.sigma;
    return row;
}

Machine thisMachine() {
    Machine machine;
    std::array<char, HOST_NAME_MAX + 1> name{};
    if (gethostname(name.data(), name.size() - 1) == 0) machine.host = name.data();
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) {
            machine.processor = line.substr(std::min(line.size(), line.find(':') + 2));
            break;
        }
    machine.cores = std::thread::hardware_concurrency();
    machine.memory_mib =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)) / 0x1p20;
    return machine;
}

}  // namespace edgewise::compare
