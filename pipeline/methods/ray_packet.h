// Embree's packets by their width.
#pragma once

#include <embree3/rtcore.h>

namespace edgewise {

template <int kWidth>
struct RayPacket;

template <>
struct RayPacket<4> {
    using Hit = RTCRayHit4;
    static constexpr auto intersect = rtcIntersect4;
};

template <>
struct RayPacket<8> {
    using Hit = RTCRayHit8;
    static constexpr auto intersect = rtcIntersect8;
};

template <>
struct RayPacket<16> {
    using Hit = RTCRayHit16;
    static constexpr auto intersect = rtcIntersect16;
};

}  // namespace edgewise
