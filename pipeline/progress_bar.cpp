#include "pipeline/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace edgewise {
namespace {

constexpr std::size_t kBarCells = 30;
constexpr std::chrono::milliseconds kRedrawInterval{100};
constexpr const char* kWipeLine = "\r\x1b[K";

std::atomic<bool> line_is_drawn{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler asks it

}  // namespace

void wipeProgressLine() noexcept {
    if (!line_is_drawn.exchange(false)) return;
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kWipeLine, std::strlen(kWipeLine));
}

std::string progressLine(std::string_view name, std::size_t done, std::size_t total) {
    if (total == 0) return std::string(name);
    const double share = static_cast<double>(std::min(done, total)) / static_cast<double>(total);
    const auto filled = static_cast<std::size_t>(share * kBarCells);
    return fmt::format("{} [{:.<{}}] {:3.0f} %", name, std::string(filled, '#'), kBarCells,
                       std::floor(share * 100.0));
}

ProgressBar::ProgressBar(bool draw, const std::atomic<bool>& interrupted)
    : draw_(draw), interrupted_(interrupted) {}

ProgressBar::~ProgressBar() {
    wipeProgressLine();
}

void ProgressBar::stage(std::string_view name, std::size_t total) {
    const std::scoped_lock lock(drawing_);
    name_ = name;
    done_ = 0;
    total_ = total;
    next_draw_ = {};
    redraw();
}

void ProgressBar::advance(std::size_t done) {
    done_ += done;
    if (!draw_) return;
    const std::unique_lock lock(drawing_, std::try_to_lock);
    if (lock) redraw();
}

bool ProgressBar::cancelled() {
    return interrupted_;
}

void ProgressBar::redraw() {
    const auto now = std::chrono::steady_clock::now();
    if (!draw_ || now < next_draw_) return;
    next_draw_ = now + kRedrawInterval;
    line_is_drawn = true;
    std::fputs((kWipeLine + progressLine(name_, done_, total_)).c_str(), stderr);
}

}  // namespace edgewise
