#include "calibrate/signs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>

#include "calibrate/course.h"
#include "calibrate/matrix.h"
#include "drover/angle.h"

namespace drover::calibrate {
namespace {

using Complex = std::complex<double>;

constexpr double kWindow_s = 1.0;
constexpr double kEach_s = 0.5;
constexpr double kCourseFrom_m = 0.15;  // of a window, to have a course
constexpr double kMostTurn_rad = 1.2;   // of a window: more may be a turn back
constexpr double kStraight_rad = 0.04;
constexpr double kLeastStraight_m = 2;
constexpr double kSameWay = 0.7;  // of 1, or of minus 1
constexpr double kSure = 4;       // sigmas

/// What happened within a window.
struct Window {
  double left_m = 0;
  double right_m = 0;
  double gyro_rad = 0;
  double turn_rad = 0;  ///< by headings, or by the course
  Complex way;          ///< of the antenna: by headings as seen from its line, else east and north
};

/// Least squares of `y` on two real columns, with a little stiffness that shares what
/// cannot be told apart; weights go down for what does not fit.
struct Regression {
  static constexpr std::size_t kColumns = 2;
  std::array<Complex, kColumns> value{};
  std::array<double, kColumns> sigma{};

  template <class Columns, class Result>
  void fit(const std::vector<Window>& windows, const Columns& columns, const Result& result) {
    std::vector<double> weights(windows.size(), 1.0);
    for (int round = 0; round < 4; ++round) {
      solve(windows, columns, result, weights);
      std::vector<double> off(windows.size());
      double sum = 0;
      for (std::size_t i = 0; i < windows.size(); ++i) {
        off[i] = std::norm(result(windows[i]) - model(columns(windows[i])));
        sum += weights[i] * off[i];
      }
      double weight = 1e-12;
      for (const double w : weights) weight += w;
      const double mean = std::max(sum / weight, 1e-12);
      for (std::size_t i = 0; i < windows.size(); ++i) weights[i] = 1 / (1 + off[i] / (4 * mean));
      for (double& s : sigma) s = std::sqrt(s * 2 * mean);
    }
  }
  Complex model(const std::array<double, kColumns>& at) const {
    Complex sum = 0;
    for (std::size_t i = 0; i < kColumns; ++i) sum += value[i] * at[i];
    return sum;
  }

 private:
  template <class Columns, class Result>
  void solve(const std::vector<Window>& windows, const Columns& columns, const Result& result,
             const std::vector<double>& weights) {
    Matrix<kColumns, kColumns> a{};
    std::array<Complex, kColumns> b{};
    for (std::size_t w = 0; w < windows.size(); ++w) {
      const auto at = columns(windows[w]);
      for (std::size_t i = 0; i < kColumns; ++i) {
        b[i] += weights[w] * at[i] * result(windows[w]);
        for (std::size_t j = 0; j < kColumns; ++j) a[i][j] += weights[w] * at[i] * at[j];
      }
    }
    for (std::size_t i = 0; i < kColumns; ++i) a[i][i] += 1e-3;
    const auto inverse = inverse_of(a).value_or(Matrix<kColumns, kColumns>{});
    for (std::size_t i = 0; i < kColumns; ++i) {
      value[i] = 0;
      for (std::size_t j = 0; j < kColumns; ++j) value[i] += inverse[i][j] * b[j];
      sigma[i] = inverse[i][i];
    }
  }
};

class SignSearch final {
 public:
  SignSearch(const Drive& drive, const Configured& configured)
      : drive_(drive),
        track_(track_of(drive)),
        has_headings_(!drive.headings_rad.empty()),
        width_m_(configured.track_m * configured.yaw_slip_factor),
        offset_rad_(to_rad(-configured.heading_baseline_offset_deg)) {}

  Signs find(FirstGuess& guess) {
    guess.heading_rad = offset_rad_;
    cut_windows();
    Signs signs;
    fit();
    if (!sides_are_clear()) {
      signs.refused =
          "whether a side is reversed or the sides are swapped is not clear: drive a left and a "
          "right circle, and 10 m straight";
      return signs;
    }
    has_headings_ ? judge_with_headings(signs, guess) : judge_by_course(signs);
    judge_gyro(signs);
    guess.turn_gain = turn_gain();
    return signs;
  }

 private:
  std::optional<Window> window(double from_s) const {
    const double to_s = from_s + kWindow_s;
    const auto a = antenna_at(drive_.places, from_s);
    const auto b = antenna_at(drive_.places, to_s);
    if (!a || !b || !track_.left_mps.covers(from_s, to_s, kLongestGap_s)) return std::nullopt;
    Window made;
    made.way = Complex(b->x_m - a->x_m, b->y_m - a->y_m);
    return has_headings_ ? with_headings(made, from_s, to_s) : with_course(made, from_s, *b);
  }
  void integrate(Window& window, double from_s, double to_s) const {
    window.left_m = track_.left_mps.integral(from_s, to_s);
    window.right_m = track_.right_mps.integral(from_s, to_s);
    window.gyro_rad = track_.gyro_radps.integral(from_s, to_s);
  }
  std::optional<Window> with_headings(Window window, double from_s, double to_s) const {
    const auto before = heading_at(drive_.headings_rad, from_s);
    const auto after = heading_at(drive_.headings_rad, to_s);
    if (!before || !after) return std::nullopt;
    integrate(window, from_s, to_s);
    window.turn_rad = wrap_rad(*after - *before);
    window.way *= std::polar(1.0, -(*before + window.turn_rad / 2));
    return window;
  }
  /// The turn from the course of this window to that of the next.
  std::optional<Window> with_course(Window window, double from_s, const Point& middle) const {
    const auto end = antenna_at(drive_.places, from_s + 2 * kWindow_s);
    if (!end) return std::nullopt;
    const Complex next(end->x_m - middle.x_m, end->y_m - middle.y_m);
    if (std::abs(window.way) < kCourseFrom_m || std::abs(next) < kCourseFrom_m) return std::nullopt;
    window.turn_rad = std::arg(next * std::conj(window.way));
    if (std::abs(window.turn_rad) > kMostTurn_rad) return std::nullopt;
    window.way = (window.way + next) / 2.0;
    integrate(window, from_s + kWindow_s / 2, from_s + kWindow_s * 3 / 2);
    return window;
  }
  void cut_windows() {
    const double end_s = drive_.places.back().time_s - kWindow_s;
    for (double t = drive_.places.front().time_s; t < end_s; t += kEach_s)
      if (const auto made = window(t)) windows_.push_back(*made);
  }

  void fit() {
    turn_.fit(
        windows_,
        [](const Window& w) {
          return std::array{w.left_m, w.right_m};
        },
        [](const Window& w) { return Complex(w.turn_rad); });
    gyro_.fit(
        windows_,
        [](const Window& w) {
          return std::array{w.gyro_rad, kWindow_s};
        },
        [](const Window& w) { return Complex(w.turn_rad); });
    look_at_straights();
  }
  /// Where it did not turn both sides rolled alike, and the antenna went as the base did.
  void look_at_straights() {
    std::array<double, 2> squares{1e-9, 1e-9};
    double product = 0;
    for (const Window& w : windows_) {
      if (std::abs(w.turn_rad) > kStraight_rad) continue;
      const std::array rolled{w.left_m, w.right_m};
      for (std::size_t i = 0; i < 2; ++i) {
        way_[i] += rolled[i] * w.way;
        squares[i] += rolled[i] * rolled[i];
      }
      product += w.left_m * w.right_m;
      straight_m_ += kEach_s / kWindow_s * std::abs(w.way);
    }
    for (std::size_t i = 0; i < 2; ++i) way_[i] /= squares[i];
    alike_ = product / std::sqrt(squares[0] * squares[1]);
  }
  bool sides_are_clear() const {
    for (std::size_t i = 0; i < 2; ++i) {
      if (std::abs(turn_.value[i]) < kSure * turn_.sigma[i]) return false;
      if (has_headings_ && std::abs(way_[i]) < kSameWay) return false;
    }
    return windows_.size() > 10 && straight_m_ > kLeastStraight_m && std::abs(alike_) > kSameWay;
  }

  void judge_with_headings(Signs& signs, FirstGuess& guess) const {
    // If the left column's sign is right the antenna line points this way, else the other way.
    const double line_rad = -std::arg(way_[0]);
    const double off_rad = std::abs(wrap_rad(line_rad - offset_rad_));
    const bool sideways = std::abs(off_rad - kPi / 2) < kPi / 4;
    // Configured a quarter off it shows no ahead: then the sides are not swapped.
    bool reversed = sideways ? turn_.value[0].real() > 0 : off_rad > kPi / 2;
    const bool both = alike_ > 0;
    const bool left_is_left = (turn_.value[0].real() < 0) != reversed;
    // A whole side that is swapped and reversed is likelier an antenna line the other way round.
    if (reversed && both && !left_is_left) {
      signs.heading_opposite = true;
      reversed = false;
      guess.heading_rad = wrap_rad(line_rad);
      return;
    }
    signs.left_reversed = reversed;
    signs.right_reversed = both ? reversed : !reversed;
    signs.swapped = !left_is_left;
    const bool right_is_right = (turn_.value[1].real() > 0) != signs.right_reversed;
    if (right_is_right != left_is_left) {
      signs = {};
      signs.contradict = true;
      signs.refused =
          "the two sides turn the base the same way round: look whether both columns are of "
          "one side";
    }
    guess.heading_rad = wrap_rad(reversed ? line_rad + kPi : line_rad);
  }

  /// Without headings ahead is where it went when the wheels said so.
  void judge_by_course(Signs& signs) const {
    const double left = turn_.value[0].real();
    const double right = turn_.value[1].real();
    if (alike_ < 0) {
      if (left * right < 0) {
        signs.contradict = true;
        signs.refused = "the wheels' signs contradict the course: look at the columns";
      } else {
        signs.left_reversed = left > 0;
        signs.right_reversed = left < 0;
      }
    } else if (left > 0 && right < 0) {
      signs.contradict = true;
      signs.refused =
          "the base turns the other way than its wheels say: the sides are swapped, or both are "
          "reversed. Which of it only a receiver's heading shows: look, and put it right";
    }
  }

  void judge_gyro(Signs& signs) const {
    if (!track_.has_gyro()) return;
    signs.gyro_reversed =
        gyro_.value[0].real() < 0 && std::abs(gyro_.value[0].real()) > kSure * gyro_.sigma[0];
  }
  double turn_gain() const {
    const double half =
        (std::abs(turn_.value[0].real()) + std::abs(turn_.value[1].real())) / 2 * width_m_;
    return half > 0.05 ? half : 1;
  }

  const Drive& drive_;
  Track track_;
  bool has_headings_;
  double width_m_;
  double offset_rad_;
  std::vector<Window> windows_;
  Regression turn_;
  Regression gyro_;
  std::array<Complex, 2> way_{};  ///< of the antenna over that of each side, while straight
  double straight_m_ = 0;
  double alike_ = 0;  ///< 1: both sides told the same while straight, -1: the opposite
};

}  // namespace

Signs find_signs(const Drive& drive, const Configured& configured, FirstGuess& guess) {
  return SignSearch(drive, configured).find(guess);
}

}  // namespace drover::calibrate
