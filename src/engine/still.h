// How slow is still. Who asks for more or less than another has a reason, and it stands here.
#pragma once

namespace drover::engine {

/// Of a rim: the wheel turns. Slower may be what a drive's estimate says while it settles after its
/// boot: it needs no ramp, and is no motion that a person is told of or that is cut.
inline constexpr double kTurns_mps = 0.05;
/// Of a rim or of the base: it stands. A task may end, a pivot may begin, a place that changes is
/// not the wheels' doing, and places may be averaged over a second: on a slope some bases creep so.
inline constexpr double kStands_mps = 0.02;
/// Of the base inside the goal's tolerance: as near as it comes. Faster, the tracker still brakes.
inline constexpr double kAtGoal_mps = 0.005;
/// Of a rim: what the estimate takes for zero, and learns the gyro's zero from. Encoders and speed
/// observers dither by about so much.
inline constexpr double kEncoderRest_mps = 0.003;

}  // namespace drover::engine
