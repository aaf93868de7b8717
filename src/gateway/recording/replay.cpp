#include "gateway/recording/replay.h"

#include <algorithm>
#include <cstdio>
#include <deque>
#include <map>
#include <memory>
#include <stdexcept>

#include "config/load.h"
#include "config/old_sections.h"
#include "gateway/recording/earlier_editions.h"
#include "gateway/recording/encoder.h"
#include "gateway/recording/field_values.h"
#include "gateway/recording/mathematics.h"
#include "gateway/recording/text.h"

namespace drover::gateway {

namespace {

/// So many inputs are shown before a difference.
constexpr std::size_t kInputsShown = 8;

std::string shown(FieldKind kind, const FieldValue& value) {
  if (kind == FieldKind::text) return '"' + value.text + '"';
  if (kind == FieldKind::whole) return std::to_string(static_cast<std::int64_t>(value.bits));
  char text[40] = {};
  std::snprintf(text, sizeof text, "%.17g", std::bit_cast<double>(value.bits));
  return text;
}

/// Whether inputs that name numbers of one mean the same devices and links of the other.
bool same_wiring(const Wiring& a, const Wiring& b) {
  const auto same_link = [](const Link& one, const Link& other) {
    return one.name == other.name && one.wire == other.wire;
  };
  const auto same_slot = [](const Slot& one, const Slot& other) {
    return one.name == other.name && one.kind == other.kind && one.link == other.link;
  };
  return std::equal(a.links.begin(), a.links.end(), b.links.begin(), b.links.end(), same_link) &&
         std::equal(a.slots.begin(), a.slots.end(), b.slots.begin(), b.slots.end(), same_slot);
}

constexpr const char* kNoRecording = "this is no recording of this program's format";

RecordedConfiguration configuration_of(const RecordingHeader& header) {
  RecordedConfiguration recorded;
  recorded.loaded = config::load_text(config::in_todays_form(header.configuration), "",
                                      std::string(header.register_map));
  const auto& problems = recorded.loaded.problems;
  if (!problems.empty())
    recorded.problem =
        "its configuration is not understood: " + problems.front().text("configuration");
  return recorded;
}

/// What is done with a recording.
struct Playing {
  bool compares = true;
  const config::DroverConfig* config = nullptr;  ///< in place of the recorded one
  std::function<void(const Snapshot&)> cycle;    ///< after each
};

class Replay final {
 public:
  Replay(std::span<const std::uint8_t> file, Playing playing)
      : in_(file), playing_(std::move(playing)) {}

  Replayed run() {
    if (!begin()) return result_;
    while (!in_.left().empty() && !over_) {
      const auto record = in_.blob();
      if (!in_.good()) {
        result_.note = "it ends within a record: droverd was killed, or the disk was full";
        break;
      }
      take(record);
    }
    if (!over_) finish(Replayed::Verdict::equal, result_.note);
    if (!over_ && !ended_ && result_.note.empty())
      result_.note = "it ends without a last word: droverd was killed";
    return result_;
  }

 private:
  /// An input that was applied, as it was recorded.
  struct Latest {
    std::uint8_t kind = 0;
    Time before;
    std::vector<std::uint8_t> record;
  };

  void finish(Replayed::Verdict verdict, std::string note) {
    result_.verdict = verdict;
    result_.note = std::move(note);
  }
  /// Nothing after it is looked at.
  void give_up(std::string why) {
    over_ = true;
    char place[80] = {};
    std::snprintf(place, sizeof place, " (%s %llu cycles until then)",
                  playing_.compares ? "equal for" : "played",
                  static_cast<unsigned long long>(result_.cycles));
    finish(Replayed::Verdict::unusable, std::move(why) + place);
  }

  bool begin() {
    RecordingHeader header = read_header(in_);
    if (!in_.good()) {
      result_.note = kNoRecording;
      return false;
    }
    result_.version = header.version;
    const auto recorded = configuration_of(header);
    result_.note = recorded.problem;
    if (!recorded.problem.empty()) return false;
    const auto& loaded = recorded.loaded;
    try {
      gateway_ = std::make_unique<Gateway>(loaded.config);
      if (playing_.config != nullptr && !take_other_configuration()) return false;
    } catch (const std::runtime_error& error) {
      result_.note = error.what();
      return false;
    }
    result_.other_mathematics = header.mathematics != mathematics_fingerprint();
    edition_ = header.edition;
    if (edition_ == 1) {
      streams_ = streams_of_first_edition(gateway_->wiring());
    } else {
      for (const auto& stream : gateway_->output().streams) streams_.push_back(stream.link);
    }
    fields_ = std::move(header.fields);
    recorded_.resize(fields_.size());
    match_fields();
    return true;
  }

  bool take_other_configuration() {
    auto other = std::make_unique<Gateway>(*playing_.config);
    if (!same_wiring(gateway_->wiring(), other->wiring())) {
      result_.note = "its devices and links are not those of the configuration that is given";
      return false;
    }
    gateway_ = std::move(other);
    return true;
  }

  void match_fields() {
    std::map<std::string, std::size_t> ours;
    const auto names = field_names(*gateway_);
    for (std::size_t i = 0; i < names.size(); ++i) ours[names[i].name] = i;
    for (const auto& field : fields_) {
      const auto it = ours.find(field.name);
      const bool known = it != ours.end() && names[it->second].kind == field.kind;
      place_.push_back(known ? it->second : kNotThere);
      if (!known) result_.not_compared.push_back(field.name);
      if (known) ours.erase(it);
    }
    for (const auto& [name, index] : ours) result_.not_compared.push_back(name);
  }

  void take(std::span<const std::uint8_t> record) {
    ByteReader in(record);
    const auto kind = in.byte();
    if (kind < static_cast<std::uint8_t>(RecordKind::output)) return apply(record);
    switch (static_cast<RecordKind>(kind)) {
      case RecordKind::output: return compare(in);
      case RecordKind::path: return keep_path(in);
      case RecordKind::gap:
        return give_up("it has a gap: the disk was too slow, and nothing after it was recorded");
      case RecordKind::end: ended_ = true; return;
    }
    give_up("it has a record of an unknown kind");
  }

  void keep_path(ByteReader& in) {
    auto path = std::make_unique<Path>(read_path(in));
    if (!in.done()) return give_up("it has a damaged path");
    const auto number = path->number;
    paths_[number] = std::move(path);
  }

  void apply(std::span<const std::uint8_t> record) {
    Latest now{0, before_, {record.begin(), record.end()}};
    if (edition_ == 1) now.record = from_first_edition(record, gateway_->wiring());
    if (edition_ == 2) now.record = from_second_edition(record);
    if (edition_ == 3) now.record = from_third_edition(record);
    if (edition_ == 4) now.record = from_fourth_edition(record);
    if (edition_ == 5) now.record = from_fifth_edition(record);
    if (edition_ <= 6) now.record = from_sixth_edition(now.record);
    if (edition_ <= 7) now.record = from_seventh_edition(now.record);
    if (edition_ <= 8) now.record = from_eighth_edition(now.record);
    ByteReader in(now.record);
    now.kind = in.byte();
    const auto find = [this](std::uint64_t number) -> const Path* {
      const auto it = paths_.find(number);
      return it == paths_.end() ? nullptr : it->second.get();
    };
    const Input input = read_input(now.kind, before_, find, in);
    if (!in.done()) return give_up("it has a damaged input");
    if (result_.begin == kNever) result_.begin = input.time;
    result_.end = input.time;
    ++result_.inputs;
    latest_.push_back(std::move(now));  // bytes of the input stay where they are
    if (latest_.size() > kInputsShown) latest_.pop_front();
    before_ = input.time;
    // What was learned is beside the recording's own configuration: to another one it is no error.
    const bool is_learned = std::holds_alternative<LearnedRecalled>(input.body);
    if (playing_.config == nullptr || !is_learned) gateway_->apply(input);
    if (std::holds_alternative<Tick>(input.body)) {
      tick_ = input.time;
      ticked_ = true;
    }
  }

  void compare(ByteReader& in) {
    if (!ticked_) return give_up("it has an output without a cycle");
    ticked_ = false;
    if (playing_.cycle) playing_.cycle(gateway_->snapshot());
    if (!playing_.compares) {
      ++result_.cycles;
      return release_paths();
    }
    differences_.clear();
    read_fields(in);
    compare_fields();
    compare_events(in);
    compare_frames(in);
    compare_streams(in);
    if (!in.done()) return give_up("it has a damaged output");
    ++result_.cycles;
    if (!differences_.empty()) return tell_difference();
    release_paths();
  }

  void read_fields(ByteReader& in) {
    std::size_t index = 0;
    while (const auto distance = in.number()) {
      if (distance > fields_.size() - index) in.fail();
      if (!in.good()) return;
      index += distance;
      FieldValue& value = recorded_[index - 1];
      switch (fields_[index - 1].kind) {
        case FieldKind::text: value.text = in.text(); break;
        case FieldKind::real: value.bits = in.raw(); break;
        case FieldKind::whole: value.bits += static_cast<std::uint64_t>(in.signed_number()); break;
      }
    }
  }

  void compare_fields() {
    FieldValues visitor(replayed_);
    visit_fields(visitor, *gateway_);
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      if (place_[i] == kNotThere || replayed_[place_[i]] == recorded_[i]) continue;
      differs(fields_[i].name, shown(fields_[i].kind, recorded_[i]),
              shown(fields_[i].kind, replayed_[place_[i]]));
    }
  }

  void compare_events(ByteReader& in) {
    std::vector<std::string> recorded;
    const auto count = in.number();
    for (std::uint64_t i = 0; i < count && in.good(); ++i) recorded.emplace_back(in.text());
    std::vector<std::string> replayed;
    for (const auto& event : gateway_->output().engine.events)
      replayed.emplace_back(text_of(event));
    compare_lists("events", recorded, replayed);
  }

  void compare_frames(ByteReader& in) {
    for (std::size_t bus = 0; bus < gateway_->bus_count(); ++bus) {
      std::vector<std::string> recorded;
      const auto count = in.number();
      for (std::uint64_t i = 0; i < count && in.good(); ++i)
        recorded.emplace_back(text_of(read_frame(in)));
      std::vector<std::string> replayed;
      for (const auto& frame : gateway_->output().frames[bus])
        replayed.emplace_back(text_of(frame));
      compare_lists("frames of bus " + std::to_string(bus), recorded, replayed);
    }
  }

  void compare_streams(ByteReader& in) {
    const auto& streams = gateway_->output().streams;
    for (const LinkId link : streams_) {
      const auto it = std::find_if(streams.begin(), streams.end(),
                                   [link](const auto& stream) { return stream.link == link; });
      const StreamOutput stream = it == streams.end() ? StreamOutput{} : *it;
      const std::string name(link == kNowhere ? "nobody" : gateway_->wiring().links[link].name);
      compare_bytes("bytes for " + name, in.blob(), stream.bytes);
      compare_lists("speed for " + name, {std::to_string(in.number())},
                    {std::to_string(stream.reopen_baud)});
    }
  }

  /// Shown from where they differ: the text of many bytes leaves the last ones out.
  void compare_bytes(const std::string& what, std::span<const std::uint8_t> recorded,
                     std::span<const std::uint8_t> replayed) {
    const auto apart = std::ranges::mismatch(recorded, replayed).in1 - recorded.begin();
    const auto same = static_cast<std::size_t>(apart);
    if (same == recorded.size() && same == replayed.size()) return;
    const auto shown = [same](std::span<const std::uint8_t> bytes) {
      return same == bytes.size() ? "none" : text_of(bytes.subspan(same));
    };
    differs(what + "[" + std::to_string(same) + "]", shown(recorded), shown(replayed));
  }

  void compare_lists(const std::string& what, const std::vector<std::string>& recorded,
                     const std::vector<std::string>& replayed) {
    const auto at = [](const auto& list, std::size_t i) {
      return i < list.size() ? list[i] : std::string("none");
    };
    for (std::size_t i = 0; i < std::max(recorded.size(), replayed.size()); ++i)
      if (at(recorded, i) != at(replayed, i))
        differs(what + "[" + std::to_string(i) + "]", at(recorded, i), at(replayed, i));
  }

  void differs(std::string what, std::string recorded, std::string replayed) {
    differences_.push_back(
        {0, tick_, std::move(what), std::move(recorded), std::move(replayed), 0, {}});
  }

  void tell_difference() {
    over_ = true;
    result_.difference = std::move(differences_.front());
    result_.difference.cycle = result_.cycles;
    result_.difference.more = differences_.size() - 1;
    for (const auto& it : latest_) result_.difference.inputs.push_back(words_of(it));
    finish(Replayed::Verdict::differs, "");
  }

  /// Its path may be gone: the number is enough.
  std::string words_of(const Latest& it) const {
    Path path;
    const auto find = [&path](std::uint64_t number) {
      path.number = number;
      return &path;
    };
    ByteReader in(it.record);
    in.byte();
    return text_of(read_input(it.kind, it.before, find, in), gateway_->wiring());
  }

  /// A recording may have given one path to two tasks of a cycle.
  void release_paths() {
    std::vector<std::uint64_t> released;
    for (const auto& event : gateway_->output().engine.events)
      if (const auto* gone = std::get_if<PathReleased>(&event.body); gone && gone->path != nullptr)
        released.push_back(gone->path->number);
    for (const auto number : released) paths_.erase(number);
  }

  static constexpr std::size_t kNotThere = SIZE_MAX;

  ByteReader in_;
  Playing playing_;
  Replayed result_;
  std::map<std::uint64_t, std::unique_ptr<const Path>> paths_;  ///< outlive the gateway
  std::unique_ptr<Gateway> gateway_;
  std::uint8_t edition_ = kEdition;
  std::vector<LinkId> streams_;     ///< whose outputs the recording has
  std::vector<FieldName> fields_;   ///< of the recording
  std::vector<std::size_t> place_;  ///< of each among ours
  std::vector<FieldValue> recorded_;
  std::vector<FieldValue> replayed_;
  std::vector<Difference> differences_;  ///< of this cycle
  std::deque<Latest> latest_;
  Time before_{};
  Time tick_ = kNever;
  bool ticked_ = false;
  bool ended_ = false;
  bool over_ = false;
};

}  // namespace

Replayed replay(std::span<const std::uint8_t> file) {
  return Replay(file, {}).run();
}

RecordedConfiguration recorded_configuration(std::span<const std::uint8_t> file) {
  ByteReader in(file);
  const RecordingHeader header = read_header(in);
  if (in.good()) return configuration_of(header);
  RecordedConfiguration none;
  none.problem = kNoRecording;
  return none;
}

Replayed play(std::span<const std::uint8_t> file, const config::DroverConfig* config,
              const std::function<void(const Snapshot&)>& cycle) {
  return Replay(file, {false, config, cycle}).run();
}

}  // namespace drover::gateway
