// Requests: what each needs before it goes to the engine or to the disk.
#include "publish/command_service.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <variant>

#include "publish/rtk_navigation/trajectory_data.h"
#include "store/drivable.h"
#include "store/point_texts.h"
#include "text/suggestion.h"

namespace drover::publish {
namespace {

constexpr double kMostStartAge_s = 1.0;
constexpr double kMostStartLead_s = 0.1;  // two clocks that are set over a network differ by less
constexpr double kAutomaticOriginRetry_s = 5.0;

Verb verb_of(const ControlCommand& request) {
  constexpr Verb kVerbs[] = {
      Verb::get_all_trajectory,    Verb::save_trajectory, Verb::delete_trajectory,
      Verb::delete_all_trajectory, Verb::start_task,      Verb::cancel_task,
      Verb::init_rtk_data,         Verb::terminate,       Verb::reset_stop,
      Verb::find_heading,          Verb::release,         Verb::hold,
      Verb::accept_position,       Verb::forget_learned};
  static_assert(std::size(kVerbs) == std::variant_size_v<ControlCommand>);
  return kVerbs[request.index()];
}

}  // namespace

CommandService::CommandService(const CommandServiceConfig& config, store::StoredState stored)
    : config_(config),
      report_(std::move(stored.report)),
      origin_(stored.origin),
      origin_problem_(std::move(stored.origin_problem)),
      mqtt_bucket_(config.max_requests_Hz, config.request_burst),
      cli_bucket_(config.max_requests_Hz, config.request_burst),
      slow_down_bucket_(config.max_requests_Hz, config.request_burst) {
  for (store::Track& track : stored.tracks) {
    std::string name = track.name;
    tracks_.insert_or_assign(std::move(name), std::move(track));
  }
}

void CommandService::begin(Time now, Actions& out) {
  for (std::string& line : report_) out.push_back(LogLine{Notice::Level::warning, std::move(line)});
  report_.clear();
  if (!origin_problem_.empty()) out.push_back(LogLine{Notice::Level::error, origin_problem_});
  if (!origin_) return;
  const RequestId id = next_id(RequestId::Source::internal);
  Pending& pending = expect(id, Verb::init_rtk_data);
  pending.origin = *origin_;
  send(id, now, SetOrigin{*origin_}, out);
}

void CommandService::on_control(std::string_view payload, const Arrival& arrival, Time now,
                                Actions& out) {
  if (!admit(payload, now, out)) return;
  on_parsed(payload, parse_control(payload, arrival.retain, config_.limits), arrival, now, out);
}

bool CommandService::admit(std::string_view payload, Time now, Actions& out) {
  if (payload.empty()) return false;  // how a retained message is taken back: nobody asks
  if (payload.size() <= kShortMessageBytes && may_stop(payload)) return true;
  if (mqtt_bucket_.take(now)) return true;
  slow_down(payload, too_many_requests(), now, out);
  return false;
}

void CommandService::on_unparsed(std::string_view payload, Time now, Actions& out) {
  slow_down(payload, kTooMuchUnread, now, out);
}

void CommandService::on_parsed(std::string_view payload,
                               Result<ControlCommand, ControlRefusal> request,
                               const Arrival& arrival, Time now, Actions& out) {
  if (is_stop(request)) {
    return handle(next_id(RequestId::Source::mqtt), std::move(request.value()), now, out);
  }
  // It was let in for what it might have been.
  if (payload.size() <= kShortMessageBytes && may_stop(payload) && !mqtt_bucket_.take(now)) {
    return slow_down(payload, too_many_requests(), now, out);
  }
  if (!request.ok()) {
    const ControlRefusal& refusal = request.error();
    out.push_back(
        PublishText{kTopicFeedback, feedback_text(refusal.feedback_cmd, refusal.reason, {})});
    out.push_back(LogLine{Notice::Level::warning,
                          "mqtt_control: " + refusal.feedback_cmd + ": " + refusal.reason});
    return;
  }
  const RequestId id = next_id(RequestId::Source::mqtt);
  if (is_duplicate(id, payload, *request, now)) return answer_duplicate(id, out);
  if (const auto* to_start = std::get_if<StartTaskRequest>(&*request)) {
    if (const auto why = untimely(*to_start, arrival, now)) {
      return tell(id, Verb::start_task, false, *why, out);
    }
  }
  handle(id, std::move(request.value()), now, out);
}

/// A start that was pressed some time ago must not move a robot that nobody looks at any more.
std::optional<std::string> CommandService::untimely(const StartTaskRequest& request,
                                                    const Arrival& arrival, Time now) const {
  if (!arrival.late.empty()) return std::string(arrival.late);
  if (last_cli_stop_ != kNever && now - last_cli_stop_ < kBrokerLateUnnoticed)
    return "a stop came by the command line just now, and may be younger than this; try again";
  if (!request.time) {
    if (!config_.start_needs_time) return std::nullopt;
    return "'time' is missing: when it was pressed, in seconds or milliseconds since 1970";
  }
  const double age_s = to_s(arrival.wall - *request.time);
  char text[80];
  if (age_s > kMostStartAge_s) {
    std::snprintf(text, sizeof text, "it was pressed %.1f s ago, more than 1 s: press again",
                  age_s);
    return text;
  }
  if (age_s < -kMostStartLead_s) {
    std::snprintf(text, sizeof text, "its time is %.1f s ahead of the robot's clock", -age_s);
    return text;
  }
  return std::nullopt;
}

void CommandService::on_cli(std::uint64_t number, ControlCommand request, Time now, Actions& out) {
  const RequestId id{RequestId::Source::cli, number};
  if (!is_stop(request) && !cli_bucket_.take(now)) {
    out.push_back(Answer{id, false, too_many_requests()});
    return;
  }
  if (is_stop(request)) last_cli_stop_ = now;
  handle(id, std::move(request), now, out);
}

std::string CommandService::too_many_requests() const {
  return "slow down: " + mqtt_bucket_.in_words("requests");
}

/// Parses only what is short, and only as often as it answers.
void CommandService::slow_down(std::string_view payload, std::string_view why, Time now,
                               Actions& out) {
  if (!slow_down_bucket_.take(now)) return;
  std::string cmd = failure_cmd("");
  if (payload.size() <= kShortMessageBytes) {
    const auto request = parse_control(payload, Retain::no, config_.limits);
    cmd = request.ok() ? failure_cmd(verb_of(*request)) : request.error().feedback_cmd;
  }
  out.push_back(PublishText{kTopicFeedback, feedback_text(cmd, why, {})});
}

/// A broker that delivers "at least once" may deliver a start twice. Two starts of a person with
/// anything between them (a cancel, the end of the task) are two.
bool CommandService::is_duplicate(RequestId id, std::string_view payload,
                                  const ControlCommand& request, Time now) {
  if (!std::holds_alternative<StartTaskRequest>(request)) return false;
  const bool again = last_start_ == payload && changes_ == last_start_changes_ &&
                     now - last_start_time_ <= from_s(config_.duplicate_window_s);
  if (!again) {
    last_start_id_ = id;
    last_start_refusal_.reset();
    last_start_again_ = 0;
    last_start_ = payload;
    last_start_time_ = now;
    last_start_changes_ = changes_ + 1;  // handling it counts as one
  }
  return again;
}

/// A refused start stays refused, also when what hindered it is over: a late second delivery must
/// not move a robot whose operator read a refusal. A person who pressed again is told so again.
void CommandService::answer_duplicate(RequestId id, Actions& out) {
  if (last_start_refusal_) {
    return tell(id, Verb::start_task, false, *last_start_refusal_, out);
  }
  const Pending* first = find(last_start_id_);
  if (first != nullptr && !first->answered) ++last_start_again_;
  out.push_back(LogLine{Notice::Level::info, "start_task came twice and counts once"});
}

void CommandService::handle(RequestId id, ControlCommand request, Time now, Actions& out) {
  if (find(id) != nullptr) {
    out.push_back(Answer{id, false, "this request number is in use"});
    return;
  }
  if (!std::holds_alternative<GetAllTrajectory>(request)) ++changes_;
  if (std::holds_alternative<GetAllTrajectory>(request)) {
    get_all(id, out);
  } else if (auto* to_save = std::get_if<SaveTrajectory>(&request)) {
    save(id, std::move(*to_save), out);
  } else if (auto* to_delete = std::get_if<DeleteTrajectory>(&request)) {
    remove(id, std::move(*to_delete), out);
  } else if (std::holds_alternative<DeleteAllTrajectory>(request)) {
    if (disk_behind(0)) {
      return tell(id, Verb::delete_all_trajectory, false, "the disk is behind, try again", out);
    }
    expect(id, Verb::delete_all_trajectory);
    out.push_back(store::StorageJob{id, store::DeleteAllTracks{}});
  } else if (const auto* to_start = std::get_if<StartTaskRequest>(&request)) {
    start(id, *to_start, now, out);
  } else if (std::holds_alternative<InitRtkData>(request)) {
    propose_origin(id, now, out);
  } else if (std::holds_alternative<ResetStopRequest>(request)) {
    expect(id, Verb::reset_stop);
    send(id, now, ResetStop{}, out);
  } else if (std::holds_alternative<FindHeadingRequest>(request)) {
    expect(id, Verb::find_heading);
    send(id, now, FindHeading{}, out);
  } else if (const auto* release = std::get_if<ReleaseRequest>(&request)) {
    expect(id, Verb::release);
    send(id, now, ReleaseHold{release->on_slope}, out);
  } else if (std::holds_alternative<HoldRequest>(request)) {
    expect(id, Verb::hold);
    send(id, now, ArmHold{}, out);
  } else if (std::holds_alternative<AcceptPositionRequest>(request)) {
    expect(id, Verb::accept_position);
    send(id, now, AcceptPosition{}, out);
  } else if (std::holds_alternative<ForgetLearnedRequest>(request)) {
    expect(id, Verb::forget_learned);
    send(id, now, ForgetLearned{}, out);
  } else if (auto* terminate = std::get_if<TerminateRequest>(&request)) {
    expect(id, Verb::terminate).note = std::move(terminate->note);
    send(id, now, EngageStop{}, out);
  } else if (auto* cancel = std::get_if<CancelTaskRequest>(&request)) {
    expect(id, Verb::cancel_task).note = std::move(cancel->note);
    send(id, now, CancelTask{}, out);
  }
}

void CommandService::get_all(RequestId id, Actions& out) {
  std::size_t points = 0;
  std::size_t bytes = 2;
  for (const auto& [name, track] : tracks_) {
    points += track.points.size();
    bytes += store::list_bytes(track);
  }
  if (bytes > config_.max_message_bytes) {
    return tell(id, Verb::get_all_trajectory, false,
                "the tracks have " + std::to_string(points) + " points, " + std::to_string(bytes) +
                    " bytes as a list, and one message carries " +
                    std::to_string(config_.max_message_bytes) + "; delete some",
                out);
  }
  if (bytes_under_way_ > 0 && bytes_under_way_ + bytes > config_.max_message_bytes) {
    return tell(id, Verb::get_all_trajectory, false,
                "the broker has not taken the last list yet, try again", out);
  }
  TrajectoryList list(bytes);
  for (const auto& [name, track] : tracks_) {
    if (store::holds_under(track, origin_)) {
      list.add(track);
    } else {
      list.add(store::derive(track, origin_, config_.antenna));
    }
  }
  if (id.source == RequestId::Source::cli) {
    out.push_back(Answer{id, true, list.take()});
  } else {
    out.push_back(PublishText{kTopicTrajectoryData, list.take()});
    bytes_under_way_ += bytes;
  }
}

void CommandService::save(RequestId id, SaveTrajectory request, Actions& out) {
  const std::size_t bytes = store::list_bytes(request.track);
  if (disk_behind(bytes)) {
    return tell(id, Verb::save_trajectory, false, "the disk is behind, try again", out);
  }
  request.track.origin = origin_;
  expect(id, Verb::save_trajectory, request.track.name).bytes = bytes;
  out.push_back(store::StorageJob{id, store::SaveTrack{std::move(request.track)}});
}

void CommandService::remove(RequestId id, DeleteTrajectory request, Actions& out) {
  if (!tracks_.contains(request.name) && !being_written(request.name)) {
    return tell(id, Verb::delete_trajectory, false, "there is no track of this name", out);
  }
  if (disk_behind(0)) {
    return tell(id, Verb::delete_trajectory, false, "the disk is behind, try again", out);
  }
  expect(id, Verb::delete_trajectory, request.name);
  out.push_back(store::StorageJob{id, store::DeleteTrack{std::move(request.name)}});
}

/// A sentence to go on with, or nothing.
std::string CommandService::near_name(const std::string& name) const {
  std::vector<std::string> names;
  names.reserve(tracks_.size());
  for (const auto& [known, track] : tracks_) names.push_back(known);
  const auto meant = text::did_you_mean(name, names);
  return meant.empty() ? "" : " (" + meant + ")";
}

std::optional<std::string> CommandService::start_problem(const StartTaskRequest& request,
                                                         std::uint32_t& index) const {
  if (being_written(request.name)) return "the track is being stored or deleted, try again";
  const auto found = tracks_.find(request.name);
  if (found == tracks_.end()) return "there is no track of this name" + near_name(request.name);
  if (origin_pending()) return "the origin is being set, try again";
  if (!origin_ && !origin_problem_.empty()) return origin_problem_;
  if (!origin_) return "there is no origin yet: it needs a first RTK fixed position";
  const auto count = static_cast<std::int64_t>(found->second.points.size());
  if (count == 0) return "the track has no points";
  const std::int64_t first = config_.zero_based_ids ? 0 : 1;
  if (request.id < first || request.id > count - 1 + first) {
    return "point " + std::to_string(request.id) + " is not on the track: its ids are " +
           std::to_string(first) + " to " + std::to_string(count - 1 + first);
  }
  index = static_cast<std::uint32_t>(request.id - first);
  return std::nullopt;
}

void CommandService::start(RequestId id, const StartTaskRequest& request, Time now, Actions& out) {
  std::uint32_t index = 0;
  if (const auto problem = start_problem(request, index)) {
    return tell(id, Verb::start_task, false, *problem, out);
  }
  // The path is the task's own copy: whatever happens to the track, the task drives what it was.
  auto path = store::build_path(tracks_.at(request.name), *origin_, config_.antenna, config_.drive);
  if (!path) return tell(id, Verb::start_task, false, path.error(), out);
  path.value()->number = ++last_path_;
  paths_.push_back(std::move(path.value()));
  expect(id, Verb::start_task, request.name).task = {paths_.back().get(), request.name, request.id,
                                                     request.speed_mps};
  send(id, now, StartTask{paths_.back().get(), index, request.speed_mps}, out);
}

void CommandService::propose_origin(RequestId id, Time now, Actions& out) {
  if (origin_pending()) {
    return tell(id, Verb::init_rtk_data, false, "the origin is being set already", out);
  }
  expect(id, Verb::init_rtk_data);
  send(id, now, ProposeOrigin{}, out);
}

void CommandService::on_snapshot(const Snapshot& snapshot, Time now, Actions& out) {
  // Where a stored origin is lost, "here" is not it: the tracks of old would be driven elsewhere.
  if (!config_.automatic_origin || origin_ || !origin_problem_.empty() || origin_pending()) return;
  const bool fixed = snapshot.gnss.health == SourceState::fresh &&
                     snapshot.gnss.position.quality == FixQuality::rtk_fixed;
  if (!fixed || now < next_automatic_origin_) return;
  next_automatic_origin_ = now + from_s(kAutomaticOriginRetry_s);
  propose_origin(next_id(RequestId::Source::internal), now, out);
}

std::optional<GivenTask> CommandService::given_task(RequestId id) const {
  const auto found = pending_.find(Key{id.source, id.number});
  if (found == pending_.end() || found->second.task.path == nullptr) return std::nullopt;
  return found->second.task;
}

std::optional<store::Track> CommandService::find_track(const std::string& name) const {
  const auto found = tracks_.find(name);
  if (found == tracks_.end()) return std::nullopt;
  return store::derive(found->second, origin_, config_.antenna);
}

}  // namespace drover::publish
