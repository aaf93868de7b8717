// What becomes of a request: the track library, who waits for which answer, and what to do next.
//
// Pure: no thread, clock or I/O. Each call appends what must be done to a list of actions; the
// runtime does it in that order. All calls from one thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drover/command.h"
#include "drover/event.h"
#include "drover/path.h"
#include "drover/snapshot.h"
#include "publish/actions.h"
#include "publish/arrival.h"
#include "publish/rtk_navigation/control.h"
#include "publish/rtk_navigation/feedback.h"
#include "publish/token_bucket.h"
#include "store/derive.h"
#include "store/storage.h"

namespace drover::publish {

/// Field names are the configuration file's keys.
struct CommandServiceConfig {
  bool zero_based_ids = false;   ///< default: the first point's id is 1
  bool automatic_origin = true;  ///< the first RTK fixed position becomes the origin if none is
  double max_requests_Hz = 10;   ///< of each source; stopping is never limited
  double request_burst = 20;
  bool start_needs_time = false;    ///< a start_task without `time` is refused
  double duplicate_window_s = 1.0;  ///< the same start_task again inside it is executed once
  /// A longer trajectory_data is refused, and so much of them may be on the way: a broker closes
  /// the connection on what is over its own limit (max_packet_size).
  std::size_t max_message_bytes = store::kMaxListBytes;
  std::size_t max_pending_writes = 16;                   ///< for the disk; each may hold a track
  std::size_t max_pending_bytes = std::size_t{8} << 20;  ///< of those tracks in a list
  store::AntennaOffset antenna{};
  TrackDrive drive = TrackDrive::ahead;
  ControlLimits limits{};
};

/// What stops is shorter, and so is most else: it is parsed where it comes in. Anything longer is
/// parsed where nobody waits for it.
inline constexpr std::size_t kShortMessageBytes = 4096;

/// A task that was given to the engine and has not ended.
struct GivenTask {
  const Path* path = nullptr;  ///< until the engine gives it back
  std::string track;
  std::int64_t target_id = 0;  ///< as the operator counts
  double asked_mps = 0;
};

class CommandService final {
 public:
  CommandService(const CommandServiceConfig& config, store::StoredState stored);

  /// Once, before anything else: the stored origin goes to the engine, the report to the log.
  void begin(Time now, Actions& out);
  /// A message on mqtt_control: admit() and on_parsed() in one.
  void on_control(std::string_view payload, const Arrival& arrival, Time now, Actions& out);
  /// Whether it is worth parsing: of a flood, only what may stop the robot is. A refusal is told
  /// here. Cheap, whatever the message.
  bool admit(std::string_view payload, Time now, Actions& out);
  /// What an admitted message says, parsed here or elsewhere; `arrival` is its own.
  void on_parsed(std::string_view payload, Result<ControlCommand, ControlRefusal> request,
                 const Arrival& arrival, Time now, Actions& out);
  /// An admitted message for which the parser has no room.
  void on_unparsed(std::string_view payload, Time now, Actions& out);
  const ControlLimits& limits() const { return config_.limits; }
  /// A request of the command line; `number` is the caller's and comes back in the Answer.
  void on_cli(std::uint64_t number, ControlCommand request, Time now, Actions& out);
  void on_reply(store::StorageReply reply, Time now, Actions& out);
  void on_event(const Event& event, Actions& out);
  void on_snapshot(const Snapshot& snapshot, Time now, Actions& out);
  /// A message that could not be given to the broker: who asked for a list is told so.
  void on_unsent(const PublishText& message, std::string_view why, Actions& out);
  /// How much of what was published the broker has not acknowledged.
  void set_under_way(std::size_t bytes) { bytes_under_way_ = bytes; }
  /// A Command that found the engine's ring full, or was not to be delivered because of `why`.
  void on_undelivered(const Command& command, Actions& out, std::string_view why = {});

  /// Stored tracks by name.
  const std::map<std::string, store::Track>& tracks() const { return tracks_; }
  /// As it would be driven now; nothing when there is none of that name.
  std::optional<store::Track> find_track(const std::string& name) const;
  /// Of a start; nothing when there is none of that number.
  std::optional<GivenTask> given_task(RequestId id) const;
  const std::optional<GeodeticPoint>& origin() const { return origin_; }
  /// Another one may be in force any moment.
  bool origin_pending() const;
  /// Why a stored origin is lost, until init_rtk_data gives another; empty: it is not.
  const std::string& origin_problem() const { return origin_problem_; }
  /// Paths that the engine holds; none is left when all tasks are over.
  std::size_t paths_lent() const { return paths_.size(); }

 private:
  struct Pending {
    RequestId id;
    Verb verb = Verb::cancel_task;
    std::string name;       ///< of the track
    std::string note;       ///< goes with the success
    std::size_t bytes = 0;  ///< save_trajectory: of the list
    GeodeticPoint origin;   ///< init_rtk_data: once proposed
    bool origin_stored = false;
    bool answered = false;  ///< start_task: accepted, and start_nav is to come
    GivenTask task;         ///< start_task
  };
  using Key = std::pair<RequestId::Source, std::uint64_t>;

  void handle(RequestId id, ControlCommand request, Time now, Actions& out);
  void get_all(RequestId id, Actions& out);
  void save(RequestId id, SaveTrajectory request, Actions& out);
  void remove(RequestId id, DeleteTrajectory request, Actions& out);
  void start(RequestId id, const StartTaskRequest& request, Time now, Actions& out);
  void propose_origin(RequestId id, Time now, Actions& out);
  /// Why a path cannot be made for the request; `index` counts from 0.
  std::string near_name(const std::string& name) const;
  std::optional<std::string> start_problem(const StartTaskRequest& request,
                                           std::uint32_t& index) const;

  Pending& expect(RequestId id, Verb verb, std::string name = {});
  Pending* find(RequestId id);
  void forget(RequestId id) { pending_.erase(Key{id.source, id.number}); }
  void send(RequestId id, Time now, decltype(Command::body) body, Actions& out);
  /// Tells the one who asked, in its own way.
  void tell(RequestId id, Verb verb, bool ok, std::string_view text, Actions& out);
  void finish(RequestId id, Verb verb, bool ok, std::string_view text, Actions& out);

  void accepted(const CommandAccepted& event, Actions& out);
  void refused(RequestId id, std::string_view reason, Actions& out);
  void release(const Path* path);
  bool being_written(const std::string& name) const;
  /// Whether the disk may be asked for one more that holds so many bytes.
  bool disk_behind(std::size_t bytes) const;
  RequestId next_id(RequestId::Source source) { return {source, ++last_number_}; }
  std::string too_many_requests() const;
  void slow_down(std::string_view payload, std::string_view why, Time now, Actions& out);
  std::optional<std::string> untimely(const StartTaskRequest& request, const Arrival& arrival,
                                      Time now) const;
  bool is_duplicate(RequestId id, std::string_view payload, const ControlCommand& request,
                    Time now);
  void answer_duplicate(RequestId id, Actions& out);

  CommandServiceConfig config_;
  std::vector<std::string> report_;
  std::map<std::string, store::Track> tracks_;
  std::optional<GeodeticPoint> origin_;
  std::string origin_problem_;  ///< why the stored one is lost; empty: it is not
  std::map<Key, Pending> pending_;
  std::vector<std::unique_ptr<const Path>> paths_;
  std::uint64_t last_number_ = 0;
  std::uint64_t last_path_ = 0;
  std::size_t bytes_under_way_ = 0;
  TokenBucket mqtt_bucket_;
  TokenBucket cli_bucket_;
  TokenBucket slow_down_bucket_;  ///< answers to a flood must not be a flood
  Time next_automatic_origin_ = kNever;
  // To recognise a start_task that the broker delivered twice.
  std::uint64_t changes_ = 0;  ///< requests and task ends so far: an equal count is unchanged state
  RequestId last_start_id_;
  std::string last_start_;
  std::optional<std::string> last_start_refusal_;  ///< why, when it was refused
  std::size_t last_start_again_ = 0;  ///< how often it came again before it was decided
  Time last_start_time_ = kNever;
  Time last_cli_stop_ = kNever;
  std::uint64_t last_start_changes_ = 0;
};

}  // namespace drover::publish
