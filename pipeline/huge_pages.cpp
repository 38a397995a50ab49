#include "pipeline/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace edgewise {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;

std::size_t wholePages(std::size_t bytes) {
    return (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

/// Mapped with a page more, so that a multiple of the page's size lies in it; the rest is given back.
std::byte* mapAligned(std::size_t bytes) {
    void* const mapped =
        mmap(nullptr, bytes + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    auto* const begin = static_cast<std::byte*>(mapped);
    const std::size_t before =
        wholePages(reinterpret_cast<std::size_t>(begin)) - reinterpret_cast<std::size_t>(begin);
    if (before > 0) munmap(begin, before);
    if (before < kHugePage) munmap(begin + before + bytes, kHugePage - before);
    return begin + before;
}

}  // namespace

void* allocateZeros(std::size_t bytes) {
    if (bytes < kHugePage) {
        if (void* const memory = std::calloc(bytes, 1)) return memory;
        throw std::bad_alloc();
    }
    if (bytes > SIZE_MAX - 2 * kHugePage) throw std::bad_alloc();
    std::byte* const memory = mapAligned(wholePages(bytes));
    madvise(memory, wholePages(bytes), MADV_HUGEPAGE);  // a wish: without it there are just more pages
    return memory;
}

void freeZeros(void* memory, std::size_t bytes) noexcept {
    if (bytes < kHugePage) return std::free(memory);
    munmap(memory, wholePages(bytes));
}

}  // namespace edgewise
