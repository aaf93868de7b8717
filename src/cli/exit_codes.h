// What the programs that call drover see of the outcome; also in the help.
#pragma once

namespace drover::cli {

inline constexpr int kDone = 0;
inline constexpr int kRefused = 1;
inline constexpr int kUsage = 2;
inline constexpr int kNoDaemon = 3;

}  // namespace drover::cli
