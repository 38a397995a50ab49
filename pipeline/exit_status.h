// Exit statuses of the program, and of the workers that it starts.
#pragma once

namespace edgewise {

inline constexpr int kFailedStatus = 1;      ///< device, memory, a stated limit met
inline constexpr int kWrongInputStatus = 2;  ///< the command line or the input
inline constexpr int kInterruptedStatus = 130;

}  // namespace edgewise
