// Wall time of a method's stages.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/error.h"
#include "pipeline/methods/method.h"

namespace edgewise {

class Stopwatch {
  public:
    /// Seconds since construction or the last lap.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> passed = now - std::exchange(last_, now);
        return passed.count();
    }

    /// Books the lap under a stage, but for the seconds of it that others book; a stage that comes again adds
    /// up.
    void book(const std::string& stage, std::vector<StageTime>& stages, double of_others = 0.0) {
        const double seconds = std::max(lap() - of_others, 0.0);
        for (StageTime& known : stages)
            if (known.name == stage) return void(known.seconds += seconds);
        stages.push_back({stage, seconds});
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Throws Interrupted once the progress says so.
inline void checkCancelled(Progress& progress) {
    if (progress.cancelled()) throw Interrupted();
}

}  // namespace edgewise
