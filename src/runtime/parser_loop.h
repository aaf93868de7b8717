// What is parsed in threads of their own: large messages of mqtt_control, and what is large of the
// scene. One does not wait for the other.
#pragma once

#include <optional>
#include <string>

#include "publish/arrival.h"
#include "publish/rtk_navigation/control.h"
#include "publish/scene_jobs.h"
#include "runtime/parsing_thread.h"
#include "runtime/stop_requests.h"

namespace drover::runtime {

struct ParseJob {
  std::string payload;
  publish::Arrival arrival;
  StopCounts before = {};  ///< the stops that were asked for before it came
};

struct ParseReply {
  ParseJob job;
  std::optional<Result<publish::ControlCommand, publish::ControlRefusal>> request;
};

class ParserLoop final : public ParsingThread<ParseJob, ParseReply> {
 public:
  explicit ParserLoop(const publish::ControlLimits& limits)
      : ParsingThread([limits](ParseReply& reply) {
          reply.request.emplace(
              publish::parse_control(reply.job.payload, reply.job.arrival.retain, limits));
        }) {}
};

static_assert(ParserLoop::kMostWaitingBytes == publish::kMostUnreadBytes &&
                  ParserLoop::kMostUnderWay == publish::kMostUnread,
              "kTooMuchUnread tells the numbers");

class SceneParserLoop final : public ParsingThread<publish::SceneTextJob, publish::SceneTextReply> {
 public:
  SceneParserLoop() : ParsingThread(publish::do_scene_text_job) {}
};

}  // namespace drover::runtime
