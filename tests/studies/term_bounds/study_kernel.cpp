#include "tests/studies/term_bounds/study_kernel.h"

#include "tests/studies/term_bounds/term_bounds.h"

namespace edgewise::study {
namespace {

struct Choice {
    const char* name;
    double radius, sigma;  // sigma 0: the kernel's own, or none
};

constexpr Choice kRadial[] = {{"disk", 0.5, 0},     {"disk", 1000, 0},    {"cone", 1, 0},
                              {"cone", 0x1p-10, 0}, {"gaussian", 2, 0},   {"gaussian", 2, 0.05},
                              {"gaussian", 2, 20},  {"poly:1,2,3", 2, 0}, {"poly:1,-2,1", 1.3, 0}};
constexpr Choice kSeparable[] = {{"box", 0.5, 0},
                                 {"tent", 1, 0},
                                 {"tent", 0x1p-10, 0},
                                 {"gaussian-separable", 2, 0},
                                 {"gaussian-separable", 4, 0.25},
                                 {"bspline", 2, 0},
                                 {"mitchell", 2, 0},
                                 {"catmull-rom", 2, 0},
                                 {"lanczos", 3, 0},
                                 {"lanczos", 1.37, 0}};

std::string describe(const Choice& c) {
    char text[80];
    std::snprintf(text, sizeof text, c.sigma > 0 ? "%s R=%g s=%g" : "%s R=%g", c.name, c.radius, c.sigma);
    return text;
}

template <class Visit>
void forChoices(bool radial, const Visit& visit) {
    if (radial)
        for (const Choice& c : kRadial) visit(c);
    else
        for (const Choice& c : kSeparable) visit(c);
}

}  // namespace

std::vector<std::string> kernelNames(bool radial) {
    std::vector<std::string> names;
    forChoices(radial, [&](const Choice& c) { names.push_back(describe(c)); });
    return names;
}

std::vector<std::unique_ptr<StudyKernel>> makeStudyKernels(bool radial) {
    std::vector<std::unique_ptr<StudyKernel>> kernels;
    forChoices(radial, [&](const Choice& c) {
        const Prefilter filter =
            makePrefilter(c.name, c.radius, c.sigma > 0 ? std::optional<double>(c.sigma) : std::nullopt);
        kernels.push_back(std::make_unique<StudyKernel>(filter, describe(c)));
    });
    return kernels;
}

}  // namespace edgewise::study
