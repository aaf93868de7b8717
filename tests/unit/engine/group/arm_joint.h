// A joint with a weight behind a drive that keeps an impedance law, for tests of what commands it.
#pragma once

#include <algorithm>
#include <cmath>

#include "drover/actuator.h"
#include "drover/measurement.h"

namespace drover::engine {

/// A bar that is level at 0 and hangs at -90 degrees.
struct ArmJoint {
  double inertia_kgm2 = 0.05;
  double weight_Nm = 1.5;  ///< what carries it when it is level
  double push_Nm = 0;      ///< by somebody
  double friction_Nms = 0.05;
  double damps_Nmsprad = 1;  ///< of its drive, told to rest

  bool wrong_way = false;   ///< its drive's torque
  bool stands = false;      ///< its encoder: its drive measures no motion any more
  double least_rad = -1e9;  ///< that it can tell
  double lies_rad = 0;      ///< what it tells beside that, though it goes by what is so
  double lies_radps = 0;
  bool rests = false;    ///< nothing of it moves, whatever its drive does
  double stop_rad = 10;  ///< an end that gives way a little
  double low_stop_rad = -10;
  double stop_Nmprad = 3000;
  double rubs_Nm = 0;  ///< in its gears, at any speed

  double position_rad = 0;
  double velocity_radps = 0;
  double torque_Nm = 0;  ///< of its drive
  double stood_rad = 0;
  AxisState state = AxisState::idle;
  int arming = 0;
  int arms_in = 3;  ///< cycles
  bool damps_while_arming = false;
  bool found_on = false;  ///< by a driver that has just begun
  bool clears = false;    ///< a fault, for who arms it
  bool says_on = false;   ///< and that it runs, though it was let go

  /// As its drive measures.
  double told_rad() {
    if (!stands) stood_rad = std::max(position_rad, least_rad);
    return stood_rad + lies_rad;
  }
  /// As its own law has it.
  double is_rad() { return stands ? stood_rad : position_rad; }
  double told_radps() const { return (stands ? 0 : velocity_radps) + lies_radps; }

  void obey(const AxisCommand& command) {
    const bool armed = command.request == AxisRequest::run || command.request == AxisRequest::hold;
    if (command.request == AxisRequest::idle && state == AxisState::running) {
      if (!says_on) state = AxisState::idle;
      torque_Nm = 0;
      return;
    }
    // One that was on when its driver began is asked once more, and damps meanwhile.
    if (armed && state == AxisState::running && found_on) {
      found_on = false;
      state = AxisState::arming;
      arming = arms_in;
    } else if (armed && (state == AxisState::idle || (state == AxisState::fault && clears))) {
      state = AxisState::arming;
      arming = arms_in;
    } else if (state == AxisState::arming) {
      state = !armed ? AxisState::idle : --arming <= 0 ? AxisState::running : state;
    }
    torque_Nm =
        state == AxisState::arming && damps_while_arming ? -damps_Nmsprad * velocity_radps : 0;
    if (state != AxisState::running) return;
    const Impedance& law = command.impedance;
    torque_Nm = armed ? law.stiffness_Nmprad * (law.position_rad - is_rad()) +
                            law.damping_Nmsprad * (command.velocity_radps - told_radps()) +
                            law.effort_Nm
                      : -damps_Nmsprad * told_radps();
  }

  /// What an end gives back.
  double stop_Nm() const {
    const double end_rad = std::clamp(position_rad, low_stop_rad, stop_rad);
    if (end_rad == position_rad) return 0;
    return stop_Nmprad * (end_rad - position_rad) - 10 * velocity_radps;
  }

  void step(double dt_s) {
    const double pull_Nm = -weight_Nm * std::cos(position_rad) - friction_Nms * velocity_radps;
    const double given_Nm = wrong_way ? -torque_Nm : torque_Nm;
    const double moves_Nm = given_Nm + pull_Nm + push_Nm + stop_Nm();
    velocity_radps += moves_Nm / inertia_kgm2 * dt_s;
    const double rubs_radps = rubs_Nm / inertia_kgm2 * dt_s;
    velocity_radps -= std::clamp(velocity_radps, -rubs_radps, rubs_radps);
    if (rests) velocity_radps = 0;
    position_rad += velocity_radps * dt_s;
  }
};

}  // namespace drover::engine
