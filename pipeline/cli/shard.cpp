#include "pipeline/cli/shard.h"

#include <fmt/format.h>

#include <cstdlib>

#include "pipeline/cli/parse_values.h"
#include "pipeline/error.h"

namespace edgewise::cli {
namespace {

constexpr std::int64_t kMost = std::int64_t{1} << 32;

Shard fromFlag(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos)
        throw InputError("--shard", fmt::format("'{}' is not of the form i/n", text));
    Shard shard;
    shard.count = parseInteger("--shard", text.substr(slash + 1), 1, kMost);
    shard.index = parseInteger("--shard", text.substr(0, slash), 1, shard.count);
    return shard;
}

std::int64_t variable(const char* name, const char* beside) {
    const char* text = std::getenv(name);
    if (!text) throw InputError(name, fmt::format("is not set, though {} is", beside));
    return parseInteger(name, text, 0, kMost);
}

Shard within(const char* name, Shard shard, const char* hint) {
    if (shard.count < 1 || shard.index < 1 || shard.index > shard.count)
        throw InputError(name, fmt::format("makes this shard {} of {}{}", shard.index, shard.count, hint));
    return shard;
}

}  // namespace

Shard readShard(const std::optional<std::string>& flag) {
    constexpr const char *kTask = "SLURM_ARRAY_TASK_ID", *kRank = "OMPI_COMM_WORLD_RANK";
    if (flag) return fromFlag(*flag);
    if (std::getenv(kTask))
        return within(kTask,
                      {variable(kTask, kTask) - variable("SLURM_ARRAY_TASK_MIN", kTask) + 1,
                       variable("SLURM_ARRAY_TASK_COUNT", kTask)},
                      ": the array's indices must have no gaps");
    if (std::getenv(kRank))
        return within(kRank, {variable(kRank, kRank) + 1, variable("OMPI_COMM_WORLD_SIZE", kRank)}, "");
    return {};
}

}  // namespace edgewise::cli
