// What is said of a droverd that lets the connection go: whether it may have done what was asked.
#include "cli/client.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cstring>
#include <functional>
#include <thread>

#include "tests/support/temp_folder.h"

namespace drover::cli {
namespace {

using testing::HasSubstr;

class AskingDroverd : public testing::Test {
 protected:
  AskingDroverd() : listener_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, path_.c_str());
    EXPECT_EQ(::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_.get(), 4), 0);
  }
  /// While `serve` has the other end, which is closed after that.
  NoAnswer ask_while(const std::function<void(int fd)>& serve) {
    std::thread daemon([&] {
      const link::UniqueFd client(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
      serve(client.get());
    });
    NoAnswer said{"it has answered"};
    try {
      (void)ask(path_, "{\"cmd\":\"reset\"}", 1);
    } catch (const NoAnswer& none) {
      said = none;
    }
    daemon.join();
    return said;
  }

  test::TempFolder folder_;
  std::string path_ = folder_.path() + "/drover.sock";
  link::UniqueFd listener_;
};

TEST_F(AskingDroverd, ThatReadsAndClosesItMayHaveDoneIt) {
  const auto said = ask_while([](int fd) {
    std::array<char, 1024> question{};
    EXPECT_GT(::recv(fd, question.data(), question.size(), 0), 0);
  });
  EXPECT_TRUE(said.asked);
  EXPECT_THAT(said.text,
              HasSubstr("closed the connection before it answered: it may have done it"));
  EXPECT_THAT(said.text, HasSubstr("drover status"));
}

TEST_F(AskingDroverd, ThatClosesAndHasNotReadItHasNotDoneIt) {
  const auto said = ask_while([](int fd) {
    char first = 0;
    EXPECT_EQ(::recv(fd, &first, 1, 0), 1);  // the line has come
  });
  EXPECT_FALSE(said.asked);
  EXPECT_THAT(said.text, HasSubstr("has not read the request: try again"));
}

TEST_F(AskingDroverd, ThatDoesNotRunItHasNotDoneIt) {
  listener_ = {};
  try {
    (void)ask(path_, "{\"cmd\":\"reset\"}", 1);
    ADD_FAILURE() << "somebody answered";
  } catch (const NoAnswer& none) {
    EXPECT_FALSE(none.asked);
    EXPECT_THAT(none.text, HasSubstr("droverd does not run"));
  }
}

}  // namespace
}  // namespace drover::cli
