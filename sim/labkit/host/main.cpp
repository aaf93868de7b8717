// The lab's supervisor: `run KEY=VALUE... -- COMMAND...` or `attach SOCKET`. sim/lab calls it.
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

#include "console.h"
#include "options.h"
#include "session.h"

namespace {

using drover::lab::Options;

void set(Options& options, std::string_view key, const std::string& value) {
  if (key == "base_dir")
    options.base_dir = value;
  else if (key == "kernel")
    options.kernel = value;
  else if (key == "init")
    options.init = value;
  else if (key == "can")
    options.can = value;
  else if (key == "logs_dir")
    options.logs_dir = value;
  else if (key == "memory")
    options.memory = value;
  else if (key == "seed")
    options.seed = std::stoull(value);
  else if (key == "timeout_s")
    options.timeout_s = std::stod(value);
  else if (key == "cpu")
    options.cpu = std::stoi(value);
  else if (key == "host_port")
    options.host_port = std::stoi(value);
  else if (key == "second_port")
    options.second_port = std::stoi(value);
  else if (key == "real_time")
    options.real_time = value == "1";
  else if (key == "interactive")
    options.interactive = value == "1";
  else if (key == "shell")
    options.shell = value == "1";
  else if (key == "env")
    options.environment.push_back(value);
  else
    throw std::runtime_error("unknown option " + std::string(key));
}

Options parse(int argc, char** argv) {
  Options options;
  int i = 2;
  for (; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const std::string_view arg = argv[i];
    const std::size_t equals = arg.find('=');
    if (equals == std::string_view::npos) throw std::runtime_error("no '=' in " + std::string(arg));
    set(options, arg.substr(0, equals), std::string(arg.substr(equals + 1)));
  }
  for (++i; i < argc; ++i) options.command.emplace_back(argv[i]);
  return options;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string_view mode = argc > 1 ? argv[1] : "";
  if (mode == "run") return drover::lab::run_session(parse(argc, argv));
  if (mode == "attach" && argc == 3) return drover::lab::attach(argv[2]);
  std::fprintf(stderr, "usage: run KEY=VALUE... -- COMMAND... | attach SOCKET\n");
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "sim/lab: %s\n", error.what());
  return 125;
}
