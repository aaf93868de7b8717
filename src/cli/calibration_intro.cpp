// What a person is told before he takes the key: which area the drive needs, and what he answers
// for.
#include <algorithm>
#include <cmath>

#include "calibrate/recipe.h"
#include "cli/calibration_drive.h"
#include "cli/shown_text.h"

namespace drover::cli {
namespace {

/// What is told of the drive, added up.
struct DriveInWords {
  double slow_m = 0;
  double leg_m = 0;
  double circle_m = 0;  ///< across, at the least
  double back_m = 0;
  double fastest_mps = 0;
  double takes_s = 0;
};

DriveInWords in_words(const calibrate::Recipe& recipe) {
  DriveInWords drive;
  for (const auto& piece : recipe.pieces()) {
    drive.takes_s += piece.stand_s;
    if (piece.stand_s > 0) continue;
    const double way_m = piece.way_m > 0 ? piece.way_m : std::abs(piece.turn_rad) * piece.radius_m;
    drive.takes_s += way_m / 2 / piece.slow_mps + way_m / 2 / piece.fast_mps;
    drive.fastest_mps = std::max(drive.fastest_mps, piece.fast_mps);
    if (piece.what.starts_with("slowly")) {
      drive.slow_m += way_m;
    } else if (!(piece.way_m > 0)) {
      drive.circle_m = 2 * piece.radius_m;
    } else {
      (drive.leg_m > 0 ? drive.back_m : drive.leg_m) = piece.way_m;
    }
  }
  return drive;
}

}  // namespace

std::string CalibrationDrive::intro() const {
  const auto area = recipe_.area();
  const auto drive = in_words(recipe_);
  const double rolls_on_m =
      drive.fastest_mps * to_s(kKeyRests) +
      drive.fastest_mps * drive.fastest_mps / (2 * config_.limits.deceleration_mps2);
  const std::string held_s = fixed(to_s(kKeyHeld), 1);
  std::string text = "Calibration drive: you hold the space key, the robot drives.\n\n";
  text += "area    level ground, nobody and nothing on it: " + fixed(area.ahead_m, 0) +
          " m ahead of the robot,\n        " + fixed(area.left_m, 0) + " m to its left, " +
          fixed(area.right_m, 0) + " m to its right, " + fixed(area.behind_m, 0) +
          " m behind it.\n";
  text += "drive   " + fixed(drive.slow_m, 0) +
          " m slowly, with a bend to the left and one to the right; " + fixed(drive.leg_m, 0) +
          " m straight on, at up to " + fixed(drive.fastest_mps, 1) +
          " m/s;\n        there a left circle and a right one, " + fixed(drive.circle_m, 1) +
          " to " + fixed(drive.circle_m * calibrate::kWider, 1) + " m across; " +
          fixed(drive.back_m, 0) + " m straight back. About " + fixed(drive.takes_s / 60, 0) +
          " minutes.\n";
  text += "you     Stand where you see all of it, with the e-stop in your hand. ";
  text += config_.clearance_required
              ? "What its scanners see stops\n        it, as always; for what they do not see you "
                "answer.\n"
              : "Nothing looks for obstacles\n        but what is wired to stop it: you answer for "
                "the way.\n";
  text +=
      "key     Hold the space key: it drives. Let it go: it comes to rest, by a ramp that begins " +
      held_s + " s\n        after the last key arrived: over a slow line " +
      fixed(to_s(kKeyRests), 1) + " s after you let go, and it drives\n        " +
      fixed(rolls_on_m, 1) +
      " m until it stands. Pressed again it goes on. q ends. A line on which keys come\n"
      "        more than " +
      fixed(to_s(kKeyLate), 1) +
      " s late is noticed, and drives nothing; nor does a terminal that does not\n"
      "        tell how late they come. Within tmux, screen, mosh and their like on the robot it "
      "is\n        refused. Not over VNC, RDP, X forwarding or a web terminal: there nobody "
      "notices.\n";
  text += "fix     It needs an RTK fix all the time: without one it stands.\n";
  return text;
}

}  // namespace drover::cli
