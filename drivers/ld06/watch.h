// What tells a scanner that sees from one that only turns, and what each sector's silence means.
// Values in, values out: turns and their counts, no time but theirs.
#pragma once

#include <cstdint>

#include "drivers/ld06/sort.h"
#include "drover/angle.h"

namespace drover::ld06 {

/// What is wrong with the latest turn, worst first. Each but the last three is a scanner that does
/// not see.
enum class Condition : std::uint8_t {
  turn_rate,  ///< the motor is too slow or too fast
  dark,       ///< nothing comes back from anywhere
  ring,       ///< something near all round: a cover
  own_only,   ///< all that comes back is the robot itself: a cover inside its outline
  frozen,     ///< the same turn over and over
  blind,      ///< most sectors are
  partly_blind,
  dirty,  ///< more comes from the robot's own place than it did
  well,
};

constexpr bool sees(Condition condition) {
  return condition >= Condition::partly_blind;
}

/// What of a motor is in order: a fifth beside 10 Hz. Slower turns are old when they are told, of
/// faster ones the points are too far apart for a pole.
inline constexpr double kTurnTolerance = 0.2;
/// Of the beams. In the dark the sensor makes up a return now and then; the thinnest place, a
/// single wall on one side, gives far more.
inline constexpr double kDarkShare = 0.02;
/// The same of those that come from a ring: a mast may stand in the way of a fifth.
inline constexpr double kRingShare = 0.8;
/// A turn is the same as the one before when so many of its returns are equal in range and
/// intensity to what came from there. With noise of a centimetre in steps of a millimetre one in
/// twenty is by chance.
inline constexpr double kSameShare = 0.98;
/// So few returns say nothing about that.
inline constexpr int kLeastReturns = 20;
/// Half a second.
inline constexpr int kFrozenTurns = 5;
/// A sector is blind when less than this part of what it usually sees comes back: sun takes two
/// thirds, another place a few tenths.
inline constexpr double kBlindShare = 0.6;
/// Back it takes this much more, so that it does not flicker.
inline constexpr double kBackShare = 0.1;
/// So wide a gap is no single beam that failed, when all of the beams have to come back. It may be
/// wider where less has to: by the default half of them five degrees, 9 cm in each metre. In two
/// turns running; for one the turn before is believed, as long as it is no older than a turn may
/// be.
inline constexpr double kGap_rad = to_rad(2.5);
/// In one turn, whatever the mean says: packets were lost, or somebody holds his hand before it.
inline constexpr double kOneTurnShare = 0.25;
/// The same of the robot itself and the lens: where a mast or a roof's posts stand there are fewer.
inline constexpr double kOwnOnlyShare = 0.8;
/// A sector in which the robot itself is seen by so many of the beams is not missed.
inline constexpr double kOwnShare = 0.3;
/// Of the points that are due in a turn. With fewer it is the line that is blind.
inline constexpr double kLossyShare = 0.8;
/// Growth of what is seen of the robot itself, of all beams: eleven degrees of dirt.
inline constexpr double kDirtShare = 0.03;

class Watch final {
 public:
  explicit Watch(const Settings& settings);

  /// A whole turn as it was told, before its beams are sorted.
  void compare(const Scan& raw);
  /// Judges the turn that was compared last, and writes its sectors. A turn of a scanner that does
  /// not see has none that are seen.
  void judge(const TurnCounts& counts, Scan& turn);
  void reset();

  Condition condition() const { return condition_; }
  int blind_sectors() const { return blind_; }  ///< of those that are not the robot's own
  /// The middle of the first of them, as a ScanPoint's bearing.
  double blind_bearing_rad() const { return blind_bearing_rad_; }
  double turn_Hz() const { return turn_Hz_; }
  int points() const { return points_; }  ///< of the latest turn
  int points_due() const { return points_due_; }

 private:
  struct Sector {
    double share = 0;    ///< of its beams that came back, over some turns
    double learned = 0;  ///< the same over minutes
    bool seen = false;   ///< by the shares
    bool gap = false;    ///< in the latest turn was one that is too wide
  };
  bool is_same(const Scan& raw) const;
  bool has_gap(const SectorCount& count, Sector& sector) const;
  Condition whole_turn(const TurnCounts& counts) const;
  void judge_sectors(const TurnCounts& counts, Scan& turn);
  void judge_dirt(const TurnCounts& counts);

  std::size_t sectors_;
  double least_share_;
  FixedVector<Sector, kMaxScanSectors> learned_;
  FixedVector<ScanPoint, kMaxScanPoints> last_;
  int same_ = 0;
  bool first_ = true;
  double own_share_ = 0;
  double usual_own_share_ = 0;
  double turn_Hz_ = 0;
  int points_ = 0;
  int points_due_ = 0;
  int blind_ = 0;
  int judged_ = 0;  ///< sectors that are not the robot's own
  double blind_bearing_rad_ = 0;
  Condition condition_ = Condition::well;
};

}  // namespace drover::ld06
