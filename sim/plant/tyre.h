// The grip of one tyre: a brush of bristles that bend, creep off while rolling, and slide.
//
// MuJoCo's own friction makes driven wheels chatter when a base skids round a turn (its force is
// right for a body that hits and rests, not for one that slides on and on), so the wheels' contacts
// carry only the normal force and the tyre adds the rest.
#pragma once

namespace drover::sim {

struct TyreConfig {
  double friction = 0.8;         ///< rubber on dry, firm ground; equal in both directions
  double stiffness_Npm = 30000;  ///< of the contact patch against the rim
  double damping_Nspm = 250;
  double relaxation_m = 0.05;  ///< rolled distance in which a bend fades to 1/e
  double roller_drag = 0.03;   ///< of the load: what turns a roller about its own axis
};

class Tyre {
 public:
  struct Force {
    double ahead_N = 0;
    double left_N = 0;
  };
  explicit Tyre(const TyreConfig& config = {}) : config_(config) {}

  /// Force of the ground on the tyre. `slip_*` is the velocity of the rim's lowest point over the
  /// ground, `roll_mps` that of the hub ahead. Without load the bristles spring back.
  Force step(double slip_ahead_mps, double slip_left_mps, double roll_mps, double load_N,
             double dt_s);
  /// The same of a wheel with rollers round it, whose axes lie `axis_rad` to the left of ahead
  /// where they touch the ground: it grips along them, and rolls away across. `rim_mps`: of the
  /// wheel. One roller is always in the middle of its width: how the touch wanders along it and
  /// goes over to the next one, and how that shakes, is left out.
  Force step_roller(double axis_rad, double slip_ahead_mps, double slip_left_mps, double rim_mps,
                    double load_N, double dt_s);
  void reset() { bend_ahead_m_ = bend_left_m_ = bend_across_m_ = 0; }

 private:
  TyreConfig config_;
  double bend_ahead_m_ = 0;
  double bend_left_m_ = 0;
  double bend_across_m_ = 0;  ///< of a roller, about its axis
};

}  // namespace drover::sim
