// Runs methods by turns, each in a process of its own, so that what disturbs the machine disturbs all alike.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/compare/comparison.h"
#include "pipeline/image_buffer.h"
#include "pipeline/methods/edge_classes.h"

namespace edgewise::compare {

struct Contender {
    std::string method;                  ///< as typed
    std::vector<std::string> arguments;  ///< of its worker
};

struct ScheduleOptions {
    int runs = 5;  ///< that are timed, after one that is not
    double budget_seconds = std::numeric_limits<double>::infinity();  ///< a method, all its runs
    std::filesystem::path scratch;                                    ///< a folder for pictures on their way
    bool pictures = true;  ///< false: times alone, nothing is taken
};

/// What a picture of row `index` is given to, once, as soon as it is there.
using TakePicture = std::function<void(std::size_t index, const ImageBuffer& picture)>;
/// After every run: rows so far, for whoever wants to resume.
using RowChanged = std::function<void(std::size_t index)>;

/// `rows` come with what is known of each contender, and leave with times, device, plan and status; a row
/// that has its runs already is left as it is. A method that fails, or spends its budget before its first
/// run ends, has a row that says so. Throws Interrupted, and InputError where a worker was given wrong input.
void runByTurns(const std::vector<Contender>& contenders, const ScheduleOptions& options,
                std::vector<Row>& rows, const TakePicture& take, const RowChanged& changed,
                Progress& progress);

/// Of a worker's reply to "run": all but its times.
void takeFacts(const nlohmann::json& reply, Row& row);

struct ReferencePicture {
    ImageBuffer picture;
    std::vector<EdgeClass> edges;        ///< by pixel; empty but for nsaa
    std::vector<judge::EdgeKind> kinds;  ///< by pixel; empty but for SDF scenes, where asked for
    std::optional<ReferenceError> error;
};

/// What is asked of a reference beside its picture.
struct ReferenceWishes {
    bool kinds = false;      ///< of edges, of SDF scenes
    bool own_error = false;  ///< with kinds, of ssaa:K
};

/// Not timed.
ReferencePicture referenceOf(const Contender& contender, const std::filesystem::path& scratch, Row& row,
                             Progress& progress, const ReferenceWishes& wishes = {});

}  // namespace edgewise::compare
