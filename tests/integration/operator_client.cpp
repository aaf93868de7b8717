#include "integration/operator_client.h"

#include <mosquitto.h>

#include "json/located_json.h"

namespace drover::test {

OperatorClient::OperatorClient(const char* id) {
  ::mosquitto_lib_init();
  client_ = ::mosquitto_new(id, true, this);
  // Otherwise a message waits up to 40 ms for the acknowledgement of the one before.
  ::mosquitto_int_option(client_, MOSQ_OPT_TCP_NODELAY, 1);
  ::mosquitto_message_callback_set(client_,
                                   [](mosquitto*, void* self, const mosquitto_message* message) {
                                     static_cast<OperatorClient*>(self)->heard_.push_back(
                                         {message->topic,
                                          {static_cast<const char*>(message->payload),
                                           static_cast<std::size_t>(message->payloadlen)}});
                                   });
  ::mosquitto_subscribe_callback_set(client_, [](mosquitto*, void* self, int, int, const int*) {
    static_cast<OperatorClient*>(self)->subscribed_ = true;
  });
}

OperatorClient::~OperatorClient() {
  ::mosquitto_destroy(client_);
  ::mosquitto_lib_cleanup();
}

bool OperatorClient::connect(int port, const char* topics) {
  subscribed_ = false;
  if (::mosquitto_connect(client_, "127.0.0.1", port, 60) != MOSQ_ERR_SUCCESS) return false;
  ::mosquitto_subscribe(client_, nullptr, topics, 1);
  for (int i = 0; i < 100 && !subscribed_; ++i) turn(std::chrono::milliseconds(50));
  return subscribed_;
}

void OperatorClient::disconnect() {
  (void)::mosquitto_disconnect(client_);
}

void OperatorClient::turn(std::chrono::milliseconds time) {
  connected_ = ::mosquitto_loop(client_, static_cast<int>(time.count()), 1) == MOSQ_ERR_SUCCESS;
}

void OperatorClient::publish(const char* topic, std::string_view text, bool retained) {
  (void)::mosquitto_publish(client_, nullptr, topic, static_cast<int>(text.size()), text.data(), 1,
                            retained);
  turn(std::chrono::milliseconds(1));
}

std::string OperatorClient::last(std::string_view topic) const {
  for (auto it = heard_.rbegin(); it != heard_.rend(); ++it)
    if (it->topic == topic) return it->text;
  return {};
}

std::vector<std::string> OperatorClient::feedback(std::size_t from) const {
  std::vector<std::string> commands;
  for (std::size_t i = from; i < heard_.size(); ++i) {
    if (heard_[i].topic != "feedback") continue;
    const auto document = json::parse(heard_[i].text);
    const auto* cmd = document ? document->root.find("cmd") : nullptr;
    commands.push_back(cmd != nullptr && cmd->text() != nullptr ? *cmd->text() : heard_[i].text);
  }
  return commands;
}

}  // namespace drover::test
