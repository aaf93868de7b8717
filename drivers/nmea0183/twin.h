// A simulated RTK receiver: five sentences an epoch, with the errors of its kind of fix.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/nmea0183/compose.h"
#include "drivers/nmea0183/twin_faults.h"
#include "drivers/noise.h"
#include "drover/options.h"
#include "drover/twin.h"

namespace drover::nmea0183 {

using Utc = std::chrono::sys_time<Duration>;
/// "yyyy-mm-ddThh:mm:ss"; nullopt for everything else.
std::optional<Utc> parse_utc(std::string_view text);

/// An epoch measured at t is told at t + latency, with the truth of t and the UTC of t.
///
/// States of set_state():
///   fix float dgps single    kind of fix; these also end `silent` and `garbage`
///   none                     epochs without a position, a speed or a heading
///   silent                   no bytes
///   garbage                  as many bytes as ever, none of them sensible
///   bad_checksum:<n>         one sentence in n is damaged; 0 ends it
///   lag:<ms>                 that much more latency, at most 2000, with the UTC of the instant; 0
///                            ends it
///   backlog:<ms/s>[:<s>]     the line is too slow: the latency grows by so much a second, up to
///                            0.4 s or to the second number; 0 ends it
///   stamp_late:<ms>          what is told is that much older than its UTC, at most 2000; 0 ends it
///   rate:<Hz>                epochs a second, 0.2 to 20
///   jump:<m>[:<deg>]         the position is that far from the truth, to the east or in that
///                            direction, counter-clockwise from east; 0 ends it
///   jump_aside:<m>           the same to the robot's left as it stands just now
///   drift:<mm/s>[:<deg>]     the position wanders from now on, from where it is, to the east or in
///                            that direction; 0 ends it at once
///   drift_aside:<mm/s>       the same to the robot's left as it stands just now
///   drift_stays              the position wanders no farther, and does not come back
///   speed_noise:<m/s>        one sigma of the speed along and across, as at rest with a float
///                            solution among trees; 0 ends it
///   stuck                    position and speed stay as they are, time runs on
///   corrections_lost         the age of corrections grows, the quality stays
///   heading_off:<deg>        the heading is that far off, clockwise; 0 ends it
///   heading_epoch:<s>        the heading is of an instant before that of the position: -2 to 0
///   heading_flip             the heading is turned by 180 degrees
///   heading_lost             the heading field is empty
///   gst_lost                 no sigmas are sent
///   clear                    ends everything but the kind of fix
class Nmea0183Twin final : public GnssTwin {
 public:
  /// Throws std::runtime_error naming the option.
  Nmea0183Twin(const Options& options, std::uint64_t seed);

  std::size_t on_tick(Time now, const GnssTruth& truth, std::span<char> out) override;
  bool set_state(std::string_view name, Time now) override;

 private:
  struct Sample {
    Time at = kNever;
    GnssTruth truth;
  };

  void remember(Time now, const GnssTruth& truth);
  GnssTruth truth_at(Time at) const;
  std::size_t write_epoch(Time at, std::span<char> out);
  Solution solve(Time at);
  GnssPosition measure_position(Time at, const GnssTruth& truth, double elapsed_s);
  GnssVelocity measure_velocity(const GnssTruth& truth);
  void follow_positions(const GnssPosition& measured, double elapsed_s);
  double measure_heading_deg(Time at, double elapsed_s);
  void damage(std::span<char> epoch);
  double asked_sigma_m() const;
  Duration period() const;

  // Settings.
  Duration configured_period_;
  Duration latency_;
  Utc utc_start_;
  std::string talker_;
  double sigma_fix_m_;
  double sigma_float_m_;
  double sigma_dgps_m_;
  double sigma_single_m_;
  double heading_sigma_deg_;
  double speed_sigma_mps_;
  bool speed_of_positions_;
  Sentences sends_;
  double gst_factor_;
  double undulation_m_;

  // State.
  Random noise_;
  Random fault_noise_;
  AxisError east_;
  AxisError north_;
  AxisError up_;
  Drift heading_error_;
  FixQuality quality_ = FixQuality::rtk_fixed;
  TwinFaults faults_;
  double sigma_m_ = 0;  ///< of each horizontal axis now; follows the kind of fix smoothly
  bool started_ = false;
  Time start_ = kNever;
  Time next_epoch_ = kNever;
  Time last_epoch_ = kNever;
  Solution last_;               ///< as it was told
  GnssPosition measured_;       ///< of the same epoch, also while another one is told
  double smooth_east_mps_ = 0;  ///< of the measured positions
  double smooth_north_mps_ = 0;
  std::vector<Sample> history_;  ///< a ring, sized once
  std::size_t newest_ = 0;
};

}  // namespace drover::nmea0183
