// The operator's MQTT session: hears every topic, says what the scenario wants said.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "drover/time.h"

struct mosquitto;
struct mosquitto_message;

namespace drover::sim {

struct MqttMessage {
  std::string_view topic;
  std::string_view payload;
  bool retained = false;
};

/// No thread of its own: the caller polls descriptor() and calls serve().
class OperatorClient {
 public:
  using OnMessage = std::function<void(const MqttMessage&)>;

  OperatorClient(int port, OnMessage on_message);
  ~OperatorClient();
  OperatorClient(const OperatorClient&) = delete;
  OperatorClient& operator=(const OperatorClient&) = delete;

  /// Connected and subscribed to everything.
  bool subscribed() const { return subscribed_; }
  /// Tries to connect when it is not connected. Cheap when nobody listens.
  void connect();
  /// -1: none.
  int descriptor() const;
  bool wants_to_write() const;
  /// Reads and writes what can be. Call it when the descriptor is ready, and each second.
  void serve(bool readable, bool writable);
  /// False: not connected.
  bool publish(const std::string& topic, std::string_view payload, bool retain);

 private:
  static void on_connect(mosquitto*, void* self, int code);
  static void on_subscribe(mosquitto*, void* self, int, int, const int*);
  static void on_disconnect(mosquitto*, void* self, int);
  static void on_message(mosquitto*, void* self, const mosquitto_message* message);

  mosquitto* client_;
  int port_;
  OnMessage on_message_;
  bool subscribed_ = false;
};

}  // namespace drover::sim
