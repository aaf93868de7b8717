// AimRT's own way with JSON: full protobuf with the options that AimRT gives it, on the types that
// protoc wrote down.  protobuf_json to|from TYPE DESCRIPTOR_SET < in > out
//
// A program of its own: the product links protobuf-lite, and both in one process clash.
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/util/json_util.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>

namespace {

namespace pb = google::protobuf;

int fail(const std::string& why) {
  std::cerr << why << "\n";
  return 1;
}

int to_json(const pb::Message& message) {
  pb::util::JsonPrintOptions options;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  std::string text;
  const auto status = pb::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) return fail(status.ToString());
  std::cout << text;
  return 0;
}

int from_json(const std::string& text, pb::Message& message) {
  const auto status = pb::util::JsonStringToMessage(text, &message);
  if (!status.ok()) return fail(status.ToString());
  std::cout << message.SerializeAsString();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return fail("usage: protobuf_json to|from TYPE DESCRIPTOR_SET");
  std::ifstream described(argv[3], std::ios::binary);
  pb::FileDescriptorSet files;
  if (!files.ParseFromIstream(&described)) return fail("that is no descriptor set");
  pb::DescriptorPool pool;
  for (const auto& file : files.file())
    if (pool.BuildFile(file) == nullptr) return fail(file.name() + " is not understood");
  const auto* type = pool.FindMessageTypeByName(argv[2]);
  if (type == nullptr) return fail("there is no such type");
  pb::DynamicMessageFactory factory;
  const std::unique_ptr<pb::Message> message(factory.GetPrototype(type)->New());
  const std::string input(std::istreambuf_iterator<char>(std::cin), {});
  if (argv[1] == std::string("from")) return from_json(input, *message);
  if (!message->ParseFromString(input)) return fail("the bytes are no such message");
  return to_json(*message);
}
