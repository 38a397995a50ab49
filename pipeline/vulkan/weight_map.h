// A visible map where weights find it on the device.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pipeline/vulkan/buffer.h"
#include "pipeline/weights.h"

namespace edgewise::vulkan {

/// Owners go by their classes' names.
class WeightMap {
  public:
    /// All of the map; nullopt where a binding of the device is too small for it.
    static std::optional<WeightMap> ofAll(const Device& device, const VisibleMap& map,
                                          const OwnerClasses& classes);
    /// What a box's samples see of it, likewise.
    static std::optional<WeightMap> around(const Device& device, const VisibleMap& map,
                                           const OwnerClasses& classes, const PixelBox& box,
                                           glm::dvec2 offset_px, double radius);

    std::size_t size() const { return size_; }  ///< segments
    /// Of the map, where here it is the i-th.
    std::uint32_t segment(std::size_t i) const {
        return ids_.empty() ? static_cast<std::uint32_t>(i) : ids_[i];
    }
    int rowBegin() const { return row_begin_; }

    const Buffer& segments() const { return segments_; }
    const Buffer& lines() const { return lines_; }
    const Buffer& rowOffsets() const { return row_offsets_; }
    const Buffer& rows() const { return rows_; }

  private:
    struct Part;
    WeightMap(const Device& device, const VisibleMap& map, const OwnerClasses& classes, const Part& part);

    std::vector<std::uint32_t> ids_;
    std::size_t size_ = 0;
    int row_begin_ = 0;
    Buffer segments_, lines_, row_offsets_, rows_;
};

}  // namespace edgewise::vulkan
