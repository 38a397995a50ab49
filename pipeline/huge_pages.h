// Memory for buffers of a picture's size: zero from the start, in huge pages where the system has them.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace edgewise {

/// At least `bytes`, all 0. Nothing is touched here: pages come where they are first written, from the thread
/// that writes them, and on Linux 2 MiB at a time. Throws std::bad_alloc.
void* allocateZeros(std::size_t bytes);
void freeZeros(void* memory, std::size_t bytes) noexcept;

/// Elements that are made without a value are 0 because their memory is: not for vectors that shrink and
/// grow again.
template <class T>
struct ZeroAllocator {
    using value_type = T;
    ZeroAllocator() = default;
    template <class U>
    ZeroAllocator(const ZeroAllocator<U>&) {}
    T* allocate(std::size_t count) { return static_cast<T*>(allocateZeros(count * sizeof(T))); }
    void deallocate(T* memory, std::size_t count) noexcept { freeZeros(memory, count * sizeof(T)); }
    template <class U>
    void construct(U*) const {}
    template <class U, class... Args>
    void construct(U* at, Args&&... args) const {
        ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
    }
    bool operator==(const ZeroAllocator&) const = default;
};

template <class T>
using ZeroedVector = std::vector<T, ZeroAllocator<T>>;

}  // namespace edgewise
