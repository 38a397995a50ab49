// Which part of a list of jobs this process does.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace edgewise::cli {

/// The jobs index - 1, index - 1 + count, ... of a list: every job is in exactly one of the `count` shards.
struct Shard {
    std::int64_t index = 1, count = 1;

    bool has(std::size_t job) const {
        return static_cast<std::int64_t>(job % static_cast<std::size_t>(count)) == index - 1;
    }
};

/// `flag` "i/n"; without it SLURM_ARRAY_TASK_ID - _MIN + 1 of _COUNT, else OMPI_COMM_WORLD_RANK + 1 of _SIZE,
/// else all. Throws InputError naming the flag or the variable for what is not 1 <= i <= n.
Shard readShard(const std::optional<std::string>& flag);

}  // namespace edgewise::cli
