// A base that keeps its last command when nobody reaches it, and of which nothing is heard.
#pragma once

namespace drover::engine {

struct SilenceInput {
  bool silent = false;  ///< nothing is heard of it, and it has power
  bool heard = false;
  bool found_powered = false;  ///< it may have a command of the program before this one
  bool stop_asked = false;     ///< by a person, since the last cycle
  bool rests = false;          ///< it is confirmed to rest, by itself or by who sees it
  bool moves = false;          ///< and it is seen to move beyond doubt
  bool slope = false;          ///< it would roll without power
  double fastest_mps = 0;      ///< of its rims, by its own word
  bool asked = false;          ///< the ramp to zero of the last command is not over
};

/// Whether what is silent may go on by a command that it has: nothing but its power stops it then.
class SilentBase final {
 public:
  /// True when a person's stop holds for it, too.
  bool update(const SilenceInput& input);
  /// Before the first update(): the program before this one knew it at rest.
  void recall_at_rest() { stood_ = true; }
  void reset() { keeps_on_ = stop_stands_ = suspect_ = false; }

  bool unheard() const { return unheard_; }
  bool ever_heard() const { return heard_; }
  /// It was not at rest when it fell silent, or nobody knows: what stands may be held up.
  bool suspect() const { return unheard_ && suspect_; }
  /// Its last command may be one that moves it.
  bool keeps_on() const { return unheard_ && keeps_on_; }
  /// Some command of ours, or of the program before this one, may be in it.
  bool has_a_command() const { return has_a_command_; }
  /// None that moved it: the program before this one knew it at rest, and it was not heard since.
  bool was_found_at_rest() const { return !heard_ && stood_; }
  /// It is heard again, with another speed than before: it was away, and needs a ramp.
  bool is_back() const { return back_; }

 private:
  bool heard_ = false;    ///< since this program began
  bool unheard_ = false;  ///< now
  bool has_a_command_ = false;
  bool keeps_on_ = false;
  bool suspect_ = false;      ///< it was not at rest when it fell silent, or nobody knows
  bool stood_ = false;        ///< it was at rest when it fell silent, or since then
  bool stop_stands_ = false;  ///< asked by a person, and it is silent since then
  bool back_ = false;
  double heard_mps_ = 0;  ///< what it said last
};

}  // namespace drover::engine
