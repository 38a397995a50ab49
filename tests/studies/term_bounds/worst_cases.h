// The worst so many of a stream.
#pragma once

#include <algorithm>
#include <vector>

namespace edgewise::study {

template <class Case>
class WorstCases {
  public:
    explicit WorstCases(std::size_t capacity) : capacity_(capacity) {}

    void offer(double error, const Case& found) {
        if (kept_.size() == capacity_ && !(error > kept_.front().error)) return;
        kept_.push_back({error, found});
        std::push_heap(kept_.begin(), kept_.end(), lessBad);
        if (kept_.size() <= capacity_) return;
        std::pop_heap(kept_.begin(), kept_.end(), lessBad);
        kept_.pop_back();
    }

    struct Kept {
        double error;
        Case found;
    };
    const std::vector<Kept>& all() const { return kept_; }

  private:
    static bool lessBad(const Kept& a, const Kept& b) { return a.error > b.error; }

    std::size_t capacity_;
    std::vector<Kept> kept_;
};

}  // namespace edgewise::study
