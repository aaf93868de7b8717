// The operator's program: an MQTT client that sends commands and keeps every message it hears.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

struct mosquitto;

namespace drover::test {

class OperatorClient final {
 public:
  struct Heard {
    std::string topic;
    std::string text;
  };

  explicit OperatorClient(const char* id = "operator");
  ~OperatorClient();
  OperatorClient(const OperatorClient&) = delete;
  OperatorClient& operator=(const OperatorClient&) = delete;

  /// True when the broker took the connection and the subscription, by default to every topic.
  bool connect(int port, const char* topics = "#");
  void disconnect();
  /// Reads and writes for so long; returns early when something came.
  void turn(std::chrono::milliseconds time);
  /// When it last read.
  bool connected() const { return connected_; }
  void publish(const char* topic, std::string_view text, bool retained = false);

  const std::vector<Heard>& heard() const { return heard_; }
  /// The newest message of a topic; empty when there is none.
  std::string last(std::string_view topic) const;
  /// The `cmd` of every feedback since `from`, in order.
  std::vector<std::string> feedback(std::size_t from = 0) const;

 private:
  mosquitto* client_;
  bool subscribed_ = false;
  bool connected_ = false;
  std::vector<Heard> heard_;
};

}  // namespace drover::test
