// Progress as one line of a terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "pipeline/progress.h"

namespace edgewise {

/// Draws on standard error when `draw` is set, at most ten times a second, and wipes its line when it is
/// destroyed. cancelled() tells what `interrupted` holds, drawn or not. Safe to use from several threads.
class ProgressBar : public Progress {
  public:
    ProgressBar(bool draw, const std::atomic<bool>& interrupted);
    ~ProgressBar() override;
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void stage(std::string_view name, std::size_t total) override;
    void advance(std::size_t done) override;
    bool cancelled() override;

  private:
    void redraw();

    const bool draw_;
    const std::atomic<bool>& interrupted_;
    std::atomic<std::size_t> done_{0}, total_{0};
    std::mutex drawing_;  ///< guards what follows
    std::string name_;
    std::chrono::steady_clock::time_point next_draw_{};
};

/// Wipes the line of the bar that is drawn, if one is. A signal handler may call it.
void wipeProgressLine() noexcept;

/// The bar's text: "visibility [#####.....]  50 %", or the name alone while the total is unknown (0).
std::string progressLine(std::string_view name, std::size_t done, std::size_t total);

}  // namespace edgewise
