// Messages of the planning scene, on the broker's topics or by drover-ros2, and their answers in
// the order in which they came.
//
// A message is parsed, then followed by the scene's thread, then stored; only then it is answered.
// What the disk does not take is answered with a note, and counts all the same. Pure, as outlets
// are.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "publish/actions.h"
#include "publish/arrival.h"
#include "publish/scene/scene_feedback.h"
#include "publish/scene_jobs.h"
#include "publish/scene_saver.h"
#include "publish/token_bucket.h"

namespace drover::publish {

/// Of clients of the broker, and likewise of ROS 2 users: neither takes the other's.
struct SceneTopicLimits {
  /// A list counts as its first message and a tenth of each other.
  double max_messages_Hz = 100;
  double message_burst = 200;
  double max_refusals_Hz = 10;  ///< of what is too much: answers to a flood must not be a flood
  double refusal_burst = 20;
  std::size_t max_waiting = 1000;                    ///< for the scene or the disk
  Duration longest_store = std::chrono::seconds(5);  ///< then it is answered with a note
};

/// Who said a message, and hears what became of it.
struct SceneSender {
  ClientId client = 0;  ///< drover-ros2; 0: a client of the broker
  Time said = kNever;   ///< kNever: when it came
};

/// What became of messages; of the broker's only `unanswered` is counted.
struct SceneCounts {
  std::uint64_t done = 0;
  std::uint64_t refused = 0;
  std::uint64_t unanswered = 0;  ///< of a flood
  std::string refusal;           ///< the last one, in words
};

inline constexpr std::string_view kNoScene = "this robot's configuration has no section scene";

/// Numbers of jobs; none twice.
class JobNumbers final {
 public:
  std::uint64_t next() { return ++last_; }

 private:
  std::uint64_t last_ = 0;
};

class SceneTopics final {
 public:
  /// The others are borrowed. Not `configured`: everything is refused, in words.
  SceneTopics(bool configured, JobNumbers& numbers, SceneSaver& saver,
              const SceneTopicLimits& limits = {});

  /// False: the topic is another one's.
  bool on_message(std::string_view topic, std::string_view payload, const Arrival& arrival,
                  Time now, Actions& out, const SceneSender& sender = {});
  /// drover-ros2 found that `name` cannot be followed. False: likewise.
  bool on_refused(std::string_view topic, std::string_view name, scene::Refusal refusal, Time now,
                  Actions& out, const SceneSender& sender);
  void on_parsed(SceneTextReply& reply, Time now, Actions& out);
  /// The parser has no room for it.
  void on_unparsed(std::uint64_t number, Actions& out);
  void on_applied(std::uint64_t number, const MessagesApplied& applied, Time now, Actions& out);
  /// The scene's thread has no room for it.
  void on_unapplied(std::uint64_t number, Actions& out);
  /// Everything up to this save is on the disk, or is not: `failure`.
  void on_saved(std::uint64_t save, std::string_view failure, Actions& out);
  /// Several times a second.
  void on_time(Time now, Actions& out);

  /// Of a flood by the broker: neither followed nor answered.
  std::uint64_t unanswered() const { return gates_[0].counts.unanswered; }
  const SceneCounts& of_ros2() const { return gates_[1].counts; }

 private:
  /// What came as one payload.
  struct Waiting {
    std::uint64_t number = 0;
    ClientId client = 0;  ///< SceneSender::client
    std::string_view topic;
    bool is_list = false;
    scene::Arrived arrived;
    std::vector<SceneAnswer> answers;
    std::vector<std::size_t> followed;  ///< which of them the scene's thread has
    std::uint64_t save = 0;             ///< not 0: waits for that one,
    Time applied = kNever;              ///< since then
    bool complete = false;
  };

  /// How much one kind of senders may say.
  struct Gate {
    TokenBucket messages;
    TokenBucket refusals;
    SceneCounts counts;
    std::size_t waiting = 0;  ///< for the scene or the disk, or for those before them
  };

  static Gate gate_with(const SceneTopicLimits& limits);
  Gate& gate_of(const SceneSender& sender) { return gates_[sender.client == 0 ? 0 : 1]; }
  std::string untimely(Time now, const SceneSender& sender);
  Waiting& expect(std::string_view topic, const Arrival& arrival, Time now,
                  const SceneSender& sender);
  Waiting* find(std::uint64_t number);
  template <class Message>
  void follow(Waiting& waiting, Result<SceneMessages<Message>, scene::Refusal> read, Time now,
              Actions& out);
  void refuse_flood(std::string_view topic, std::string_view why, Time now, Actions& out,
                    const SceneSender& sender);
  static void refuse(Waiting& waiting, std::string path, std::string why);
  static void note_unstored(Waiting& waiting, std::string_view why);
  void answer_ros2(const Waiting& waiting, Actions& out);
  /// What is complete, and before it all is.
  void answer(Actions& out);

  bool configured_;
  JobNumbers& numbers_;
  SceneSaver& saver_;
  SceneTopicLimits limits_;
  std::array<Gate, 2> gates_;
  std::deque<Waiting> waiting_;
  std::size_t parsing_ = 0;  ///< elsewhere; what comes after them waits for them
};

}  // namespace drover::publish
