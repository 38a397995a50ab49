// What a long computation tells its caller, and how it is told to stop.
#pragma once

#include <cstddef>
#include <string_view>

namespace edgewise {

/// The default says nothing and is never cancelled. advance() and cancelled() are called from many threads at
/// once.
struct Progress {
    virtual ~Progress() = default;
    virtual void stage(std::string_view /*name*/, std::size_t /*total*/) {}
    virtual void advance(std::size_t /*done*/) {}
    virtual bool cancelled() { return false; }
};

}  // namespace edgewise
