// Kernel arguments and descriptors.
#include "kernel_process.h"

#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>

#include <vector>

namespace drover::lab {
namespace {

// Descriptor numbers inside the kernel process, as named on its command line.
constexpr int kLog = 10, kOut = 11, kErr = 12, kIn = 13, kNet = 14, kFirstConsole = 15;
constexpr int kFirstFree = kFirstConsole + kSeats;

// Virtual time begins at 2026-01-01T00:00:00Z in every run.
constexpr const char* kStart_ns = "1767225600000000000";

std::vector<std::string> arguments(const Options& options, const std::string& state_dir) {
  auto fd = [](int n) { return "fd:" + std::to_string(n); };
  std::vector<std::string> args{
      options.kernel, "mem=" + options.memory, "root=/dev/root", "rootfstype=hostfs", "rootflags=/",
      "ro", "init=" + state_dir + "/init", "lab_state=" + state_dir, "con=null",
      "con0=null," + fd(kLog),
      "con1=" + (options.interactive ? fd(kIn) : std::string("null")) + "," + fd(kOut),
      "con2=null," + fd(kErr), "uml_dir=" + state_dir + "/uml", "umid=lab", "vcan.echo=1",
      "norandmaps",
      // Nothing feeds the random pool, and the first reader would burn seconds of virtual time:
      // let the seed that the kernel takes from the host at its start count.
      "random.trust_bootloader=on", "random.trust_cpu=on"};
  for (int i = 0; options.shell && i < kSeats; ++i) {
    const auto end = fd(kFirstConsole + i);
    args.push_back("con" + std::to_string(3 + i) + "=" + end + "," + end);
  }
  if (options.host_port >= 0) {
    args.push_back("vec0:transport=fd,fd=" + std::to_string(kNet) + ",vec=0");
  }
  if (!options.real_time) {
    args.push_back("time-travel=inf-cpu");
    args.push_back(std::string("time-travel-start=") + kStart_ns);
  }
  return args;
}

// Between fork and exec: only system calls.
[[noreturn]] void become_kernel(std::vector<char*>& argv, int cpu, pid_t parent,
                                const std::vector<std::pair<int, int>>& moves, int log_file) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  cpu_set_t mask;
  CPU_ZERO(&mask);
  CPU_SET(cpu, &mask);
  ::sched_setaffinity(0, sizeof mask, &mask);
  const int null = ::open("/dev/null", O_RDONLY);
  ::dup2(null, 0);
  ::dup2(log_file, 1);
  ::dup2(log_file, 2);
  for (const auto& [from, to] : moves) {
    if (from >= 0) ::dup2(from, to);
  }
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

// Moves a descriptor above the fixed numbers, so that no dup2 overwrites one still needed.
Fd raise(Fd fd) {
  const int raised = ::fcntl(fd.get(), F_DUPFD_CLOEXEC, kFirstFree);
  if (raised < 0) fail("fcntl");
  return Fd(raised);
}

}  // namespace

KernelEnds start_kernel(const Options& options, const std::string& state_dir, int cpu) {
  KernelEnds ends;
  Fd out, err, log, in, net;
  std::vector<Fd> consoles(options.shell ? kSeats : 0);
  auto wire = [](std::pair<Fd, Fd> pair, Fd& ours, Fd& theirs) {
    ours = std::move(pair.first);
    theirs = raise(std::move(pair.second));
  };
  wire(make_pipe(), ends.out, out);
  wire(make_pipe(), ends.err, err);
  wire(make_pipe(), ends.log, log);
  if (options.interactive) {
    auto [read_end, write_end] = make_pipe();
    in = raise(std::move(read_end));
    ends.in = std::move(write_end);
  }
  ends.consoles.resize(consoles.size());
  for (std::size_t i = 0; i < consoles.size(); ++i)
    wire(make_socket_pair(SOCK_STREAM), ends.consoles[i], consoles[i]);
  if (options.host_port >= 0) wire(make_socket_pair(SOCK_DGRAM), ends.net, net);
  const Fd log_file(
      ::open((state_dir + "/kernel.log").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  if (!log_file.open()) fail("cannot open kernel.log");

  std::vector<std::string> args = arguments(options, state_dir);
  std::vector<char*> argv;
  for (auto& arg : args) argv.push_back(arg.data());
  argv.push_back(nullptr);
  std::vector<std::pair<int, int>> moves{
      {log.get(), kLog}, {out.get(), kOut}, {err.get(), kErr}, {in.get(), kIn}, {net.get(), kNet}};
  for (std::size_t i = 0; i < consoles.size(); ++i)
    moves.emplace_back(consoles[i].get(), kFirstConsole + static_cast<int>(i));
  const pid_t parent = ::getpid();
  ends.pid = ::fork();
  if (ends.pid < 0) fail("fork");
  if (ends.pid == 0) become_kernel(argv, cpu, parent, moves, log_file.get());
  ::setpgid(ends.pid, ends.pid);  // both sides, so that a kill right now already works
  return ends;
}

}  // namespace drover::lab
