#include "drivers/witmotion/setup.h"

#include <algorithm>
#include <cmath>

namespace drover::witmotion {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kListen = milliseconds(1500);
constexpr Duration kListenSlow = seconds(6);    // something is heard, though seldom
constexpr Duration kReply = milliseconds(500);  // a read's answer waits for its turn on the line
constexpr Duration kPause = milliseconds(150);  // between commands
constexpr Duration kAfterSave = seconds(1);
constexpr Duration kSettle = milliseconds(2500);  // until the pace is known anew
constexpr Duration kShort = milliseconds(1500);
constexpr Duration kCheckAgain = seconds(30);
constexpr int kMaxTries = 3;
constexpr int kMaxRounds = 3;
constexpr int kMaxSaves = 10;         // flash wears out: from then on settings last until power-off
constexpr std::uint32_t kEnough = 2;  // frames that prove a speed

constexpr std::uint32_t kCandidates[] = {115200, 9600,  921600, 460800, 230400,
                                         57600,  38400, 19200,  4800};
constexpr Register kBlocks[] = {Register::content, Register::bandwidth, Register::algorithm};

}  // namespace

Setup::Setup(const Settings& wanted, std::uint32_t baud, bool enabled)
    : wanted_(wanted), home_baud_(baud), enabled_(enabled), line_baud_(baud) {}

void Setup::go(Step step, Time now) {
  step_ = step;
  since_ = now;
  frames_ = 0;
  asked_ = false;
  tries_ = 0;
  block_ = 0;
  short_since_ = kNever;
}

void Setup::begin_anew(Time now) {
  rounds_ = 0;
  unsaved_ = false;
  readable_ = true;
  go(Step::listen, now);
}

void Setup::on_link_up(Time now) {
  // Our own change of speed goes on where it was; a device that was plugged in begins anew.
  if (!expecting_link_) begin_anew(now);
  expecting_link_ = false;
  no_check_before_ = kNever;
  go(Step::listen, now);
}

void Setup::send(const Command& command, DriverOut& out) {
  for (const std::uint8_t byte : command) out.overflows += out.bytes.push_back(byte) ? 0 : 1;
}

void Setup::reopen(std::uint32_t baud, Time now, DriverOut& out) {
  line_baud_ = baud;
  expecting_link_ = true;
  out.reopen_baud = baud;
  go(Step::listen, now);
}

void Setup::on_tick(Time now, const Observed& seen, DriverOut& out) {
  if (!enabled_ || expecting_link_) return;
  if (since_ == kNever) since_ = now;
  switch (step_) {
    case Step::listen: return listen(now, seen, out);
    case Step::ask: return ask(now, out);
    case Step::decide: return decide(now, seen);
    case Step::write: return write(now, out);
    case Step::watch: return watch(now, seen);
  }
}

void Setup::listen(Time now, const Observed& seen, DriverOut& out) {
  if (frames_ >= kEnough) return go(Step::ask, now);
  const Duration listened = now - since_;
  if (listened < kListen || (frames_ > 0 && listened < kListenSlow)) return;
  if (seen.last_byte >= since_) {  // a talk that is not understood: at another speed?
    if (kCandidates[candidate_] == line_baud_)
      candidate_ = (candidate_ + 1) % std::size(kCandidates);
    const std::uint32_t next = kCandidates[candidate_];
    candidate_ = (candidate_ + 1) % std::size(kCandidates);
    return reopen(next, now, out);
  }
  if (line_baud_ != home_baud_) return reopen(home_baud_, now, out);
  // Its output may be switched off: it would still answer.
  send(read_registers(Register::content), out);
  since_ = now;
}

void Setup::ask(Time now, DriverOut& out) {
  if (now < quiet_until_) return;
  if (asked_ && now - since_ < kReply) return;
  if (tries_ == kMaxTries) {
    readable_ = false;
    return go(Step::decide, now);
  }
  ++tries_;
  asked_ = true;
  since_ = now;
  send(read_registers(kBlocks[block_]), out);
}

// An answer does not say which registers it holds: only one question is ever open.
void Setup::on_registers(const Registers& registers, Time now) {
  if (step_ == Step::listen) frames_ = kEnough;  // an answer: who else would know the question
  if (step_ != Step::ask || !asked_) return;
  switch (block_) {
    case 0:
      found_.content = registers.value[0];
      found_.rate = registers.value[1];
      break;
    case 1: found_.bandwidth = registers.value[0]; break;
    default: found_.algorithm = registers.value[0]; break;
  }
  // Answers to earlier tries may still come; the next question waits until they have.
  quiet_until_ = now + (tries_ > 1 ? kReply : kPause);
  asked_ = false;
  tries_ = 0;
  if (++block_ == std::size(kBlocks)) {
    readable_ = true;
    go(Step::decide, now);
  }
}

bool Setup::falls_short(const Observed& seen) const {
  if ((seen.content & wanted_.content) != wanted_.content) return true;
  const auto wanted_Hz = rate_Hz(wanted_.rate);
  if (!wanted_Hz || std::isnan(seen.pace_Hz)) return false;
  return seen.pace_Hz * kPaceTolerance < *wanted_Hz || seen.pace_Hz > *wanted_Hz * kPaceTolerance;
}

void Setup::find_differences(const Observed& seen) {
  writes_.clear();
  if (readable_) {
    if (found_.content != wanted_.content) plan(Register::content, wanted_.content);
    if (found_.rate != wanted_.rate) plan(Register::rate, wanted_.rate);
    if (found_.bandwidth != wanted_.bandwidth) plan(Register::bandwidth, wanted_.bandwidth);
    if (found_.algorithm != wanted_.algorithm) plan(Register::algorithm, wanted_.algorithm);
  } else if (falls_short(seen) || line_baud_ != home_baud_) {
    plan(Register::content, wanted_.content);
    plan(Register::rate, wanted_.rate);
    plan(Register::bandwidth, wanted_.bandwidth);
    plan(Register::algorithm, wanted_.algorithm);
  }
  // Last, because the line must be opened anew after it.
  if (line_baud_ != home_baud_) plan(Register::baud, wanted_.baud);
}

void Setup::decide(Time now, const Observed& seen) {
  find_differences(seen);
  const bool enough = rounds_ >= kMaxRounds;
  if (!writes_.empty()) {
    refused_ = refused_ || enough;
    unsaved_ = true;
  } else {
    refused_ = false;
    if (unsaved_ && saves_ < kMaxSaves) {
      plan(Register::save, kSave);
      ++saves_;
    }
    unsaved_ = false;
  }
  if (writes_.empty() || enough) {
    // A device that says that all is as wanted, though it is not, is not asked all the time.
    no_check_before_ = enough || (doubted_ && rounds_ == 0) ? now + kCheckAgain : now;
    doubted_ = false;
    return go(Step::watch, now);
  }
  ++rounds_;
  next_write_ = 0;
  next_write_at_ = now + kPause;
  unlock_next_ = true;
  go(Step::write, now);
}

void Setup::write(Time now, DriverOut& out) {
  if (now < next_write_at_) return;
  next_write_at_ = now + kPause;
  if (unlock_next_) {
    unlock_next_ = false;
    return send(write_register(Register::unlock, kUnlock), out);
  }
  if (next_write_ < writes_.size()) {
    const Write& one = writes_[next_write_++];
    if (one.address == Register::save) next_write_at_ = now + kAfterSave;
    if (next_write_ == writes_.size() && !readable_) next_write_at_ = now + kSettle;
    return send(write_register(one.address, one.value), out);
  }
  if (writes_.back().address == Register::baud) return reopen(home_baud_, now, out);
  go(Step::listen, now);
}

void Setup::watch(Time now, const Observed& seen) {
  const bool silent = now - seen.last_byte > kShort;
  const bool noise = !silent && now - seen.last_frame > kShort;
  if (now - since_ > kShort && (silent || noise)) return begin_anew(now);
  if (!falls_short(seen)) {
    short_since_ = kNever;
  } else if (short_since_ == kNever) {
    short_since_ = now;
  } else if (now - short_since_ > kShort && now >= no_check_before_) {
    doubted_ = true;
    begin_anew(now);
  }
}

}  // namespace drover::witmotion
