// What of a calibration becomes a change of the configuration, and what only a person can change.
#include <algorithm>
#include <cmath>

#include "cli/show_calibration.h"
#include "cli/shown_text.h"
#include "json/json_text.h"

namespace drover::cli {
namespace {

using calibrate::Calibration;
using calibrate::Found;
using calibrate::Quantity;
using json::JsonText;

bool is_told(const Found& found) {
  return found.refused.empty();
}
bool is_off(const Found& found, double configured) {
  return is_told(found) && std::abs(found.value - configured) > found.interval;
}
bool is_off(const Found& found) {
  return found.has_configured && is_off(found, found.configured);
}

/// Members are texts: of a section in which nothing is off there is none.
class Patch final {
 public:
  Patch(const Calibration& it, const CalibrationKeys& keys) : it_(it), keys_(keys) {}

  std::string text() {
    base();
    estimate();
    receiver();
    if (is_off(it_.of(Quantity::drive_lag_s)))
      section("navigate", one("drive_lag_s", it_.of(Quantity::drive_lag_s).value, 3));
    return parts_.empty() ? "" : "{" + parts_ + "}";
  }

 private:
  static std::string one(const char* key, double value, int decimals) {
    JsonText out;
    out.key(key).number(value, decimals);
    return out.take();
  }
  void add(std::string& to, Quantity what, const char* key, int decimals) const {
    if (is_off(it_.of(what))) append(to, one(key, it_.of(what).value, decimals));
  }
  static void append(std::string& to, const std::string& member) {
    to += (to.empty() ? "" : ",") + member;
  }
  static std::string in(const std::string& name, const std::string& members) {
    JsonText key;
    key.key(name);
    return key.take() + "{" + members + "}";
  }
  void section(const std::string& name, const std::string& members) {
    if (!members.empty()) append(parts_, in(name, members));
  }

  void base() {
    std::string members;
    if (!keys_.twist_base) add(members, Quantity::wheel_radius_m, "wheel_radius_m", 5);
    add(members, Quantity::yaw_slip_factor, "yaw_slip_factor", 3);
    if (!members.empty()) section("groups", in("base", members));
  }
  void antenna(std::string& members, bool at_receiver) const {
    // The line, or the sides: who does not know which must not make both wrong.
    if (it_.signs.heading_opposite) return;
    if (keys_.x_at_receiver == at_receiver) add(members, Quantity::antenna_x_m, "antenna_x_m", 3);
    if (keys_.y_at_receiver == at_receiver) add(members, Quantity::antenna_y_m, "antenna_y_m", 3);
    if (keys_.heading_at_receiver == at_receiver)
      add(members, Quantity::heading_offset_deg, "heading_baseline_offset_deg", 2);
  }
  void estimate() {
    std::string members;
    antenna(members, false);
    if (!it_.signs.wrong()) certainty(members);
    section("estimate", members);
  }
  /// How well it is known from now on. An interval is two sigma.
  void certainty(std::string& members) const {
    const Found& ahead = it_.of(Quantity::antenna_x_m);
    const Found& left = it_.of(Quantity::antenna_y_m);
    if (is_told(ahead) && is_told(left))
      surer(members, "antenna_sigma_m", std::max(sigma(ahead), sigma(left)), keys_.antenna_sigma_m,
            3);
    const Found& line = it_.of(Quantity::heading_offset_deg);
    if (is_told(line))
      surer(members, "heading_mount_sigma_deg", sigma(line), keys_.heading_mount_sigma_deg, 2);
    const Found& late = it_.of(Quantity::position_late_s);
    if (keys_.own_stamps && keys_.latency_s && is_told(late))
      surer(members, "gnss_late_sigma_s", lateness_sigma_s(late), keys_.gnss_late_sigma_s, 3);
  }
  /// Of a value with the patch applied: what it leaves as it is configured counts as an error.
  static double sigma(const Found& found) {
    const double left = is_off(found) ? 0 : found.value - found.configured;
    return std::hypot(found.interval / 2, left);
  }
  /// Of positions and of headings, which share one key.
  double lateness_sigma_s(const Found& late) const {
    const bool patched = patches_latency();
    const double place_s = std::hypot(late.interval / 2, patched ? 0 : late.value);
    const Found& heading = it_.of(Quantity::heading_late_s);
    if (!is_told(heading)) return place_s;
    const double left_s = heading.value - (patched ? late.value : 0);
    return std::max(place_s, std::hypot(heading.interval / 2, left_s));
  }
  static void surer(std::string& members, const char* key, double known, double configured,
                    int decimals) {
    const double unit = std::pow(10, -decimals);
    const double rounded = std::ceil(known / unit - 1e-6) * unit;
    if (rounded < configured - unit / 2) append(members, one(key, rounded, decimals));
  }
  void receiver() {
    std::string members;
    antenna(members, true);
    if (patches_latency()) {
      const double late_s = *keys_.latency_s + it_.of(Quantity::position_late_s).value;
      append(members, in("options", one("latency_s", late_s, 3)));
    }
    if (!members.empty()) section("devices", in(keys_.receiver, members));
  }

  bool patches_latency() const {
    const Found& late = it_.of(Quantity::position_late_s);
    return keys_.own_stamps && keys_.latency_s && is_off(late, 0) &&
           *keys_.latency_s + late.value >= 0;
  }

  const Calibration& it_;
  const CalibrationKeys& keys_;
  std::string parts_;
};

class Notes final {
 public:
  Notes(const Calibration& it, const CalibrationKeys& keys) : it_(it), keys_(keys) {}

  std::vector<std::string> all() {
    signs();
    sides();
    lateness();
    const Found& scale = it_.of(Quantity::gyro_scale);
    if (is_off(scale))
      say("the gyro's turns are to be taken times " + fixed(scale.value, 4) +
          ": no key; the estimate learns it while driving");
    if (keys_.twist_base && is_off(it_.of(Quantity::wheel_radius_m)))
      say("the base's own way is to be taken times " +
          fixed(it_.of(Quantity::wheel_radius_m).value, 4) +
          ": no key; the estimate learns it while driving");
    speed();
    return std::move(notes_);
  }

 private:
  void say(std::string text) { notes_.push_back(std::move(text)); }

  void signs() {
    for (std::string& note : sign_notes(it_.signs, keys_.twist_base)) say(std::move(note));
  }
  void sides() {
    const Found& left = it_.of(Quantity::left_radius_m);
    const Found& right = it_.of(Quantity::right_radius_m);
    if (!left.refused.empty() || !right.refused.empty()) return;
    const double apart = right.value - left.value;
    if (std::abs(apart) < std::hypot(left.interval, right.interval)) return;
    say(std::string(keys_.twist_base ? "the ways of the right side are "
                                     : "the wheels of the right side are ") +
        fixed(100 * std::abs(apart) / left.value, 1) + " % " + (apart > 0 ? "larger" : "smaller") +
        " than those of the left: no key tells sides apart; look at tyres and gear ratios");
  }
  void lateness() {
    const Found& place = it_.of(Quantity::position_late_s);
    if (is_off(place, 0) && !(keys_.own_stamps && keys_.latency_s))
      say("positions are " + fixed(place.value, 3) +
          " s older than their stamps: with droverd that is added to the receiver's latency_s");
    const Found& heading = it_.of(Quantity::heading_late_s);
    if (heading.refused.empty() && place.refused.empty() &&
        std::abs(heading.value - place.value) > std::hypot(heading.interval, place.interval))
      say("headings are " + fixed(heading.value - place.value, 3) +
          " s later than positions: no key; the estimate learns it while driving");
  }
  void speed() {
    if (it_.speed_source == calibrate::SpeedSource::positions)
      say("the receiver makes its speed of its positions: it is no second witness, switch the "
          "receiver to Doppler speed if it can");
  }

  const Calibration& it_;
  const CalibrationKeys& keys_;
  std::vector<std::string> notes_;
};

}  // namespace

std::vector<std::string> sign_notes(const calibrate::Signs& signs, bool twist_base) {
  std::vector<std::string> notes;
  const auto say = [&notes](const char* text) { notes.emplace_back(text); };
  const bool wheels = !twist_base;
  if (!wheels && (signs.swapped || signs.left_reversed || signs.right_reversed))
    say("what the base tells of its own motion has wrong signs: look how it is wired, and how it "
        "is mounted");
  if (wheels && signs.swapped)
    say("left and right are swapped: exchange groups.base.left and groups.base.right");
  if (wheels && signs.left_reversed)
    say("what is configured as left tells backwards: turn \"reversed\" of its drives round");
  if (wheels && signs.right_reversed)
    say("what is configured as right tells backwards: turn \"reversed\" of its drives round");
  if (signs.gyro_reversed)
    say("the gyro turns the other way: its mount_roll_deg is 180 degrees off, or "
        "mount_pitch_deg");
  if (signs.heading_opposite)
    say("the antenna line points the other way round; or the sides are swapped and both are "
        "reversed: look which");
  return notes;
}

std::string calibration_patch(const Calibration& it, const CalibrationKeys& keys) {
  return it.found.empty() ? "" : Patch(it, keys).text();
}

std::vector<std::string> calibration_notes(const Calibration& it, const CalibrationKeys& keys) {
  return it.found.empty() ? std::vector<std::string>{} : Notes(it, keys).all();
}

}  // namespace drover::cli
