#include "bus/executor.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <string>
#include <thread>
#include <vector>

#include "bus/bus.h"
#include "bus/channels.h"
#include "bus/events.h"
#include "bus/live_executor.h"
#include "bus/simulated_executor.h"
#include "bus/transport.h"

namespace skein::bus {
namespace {

class SimulatedExecutorTest : public testing::Test {
 protected:
  std::shared_ptr<lcm::LCM> transport_ = MakeTransport("memq://").lcm;
  SimulatedExecutor executor_{transport_, 1'000'000};
  std::vector<std::string> log_;

  std::function<void()> Log(const std::string& what) {
    return [this, what] { log_.push_back(what + "@" + std::to_string(executor_.Now())); };
  }
};

TEST_F(SimulatedExecutorTest, RunsTimersAtPhasePlusMultiplesOfThePeriod) {
  executor_.Every(100, Log("a"), 30);
  executor_.RunUntil(1'000'250);
  EXPECT_EQ(log_, (std::vector<std::string>{"a@1000030", "a@1000130", "a@1000230"}));
  EXPECT_EQ(executor_.Now(), 1'000'250);
}

TEST_F(SimulatedExecutorTest, RunsTimersOfOneInstantInTheOrderOfTheirCreation) {
  executor_.Every(100, Log("first"));
  executor_.Every(50, Log("second"));
  executor_.At(1'000'100, Log("third"));
  executor_.RunUntil(1'000'100);
  EXPECT_EQ(log_,
            (std::vector<std::string>{"second@1000050", "first@1000100", "second@1000100", "third@1000100"}));
}

TEST_F(SimulatedExecutorTest, RunsWhatIsOverdueAtOnce) {
  executor_.At(5, Log("late"));
  executor_.RunFor(0);
  EXPECT_EQ(log_, (std::vector<std::string>{"late@1000000"}));
}

TEST_F(SimulatedExecutorTest, DeliversMessagesAndTheirAnswersBeforeTheNextTimerOfTheInstant) {
  Bus bus(transport_, "node", executor_);
  Events events(bus);
  bus.Subscribe<event_t>(channel::kEvent, [&](const event_t& event) {
    Log(event.code)();
    if (event.code == "question") events.Tell(event_t::INFO, "answer", "");
  });
  executor_.At(1'000'010, [&] { events.Tell(event_t::INFO, "question", ""); });
  executor_.At(1'000'010, Log("timer"));
  executor_.RunFor(10);
  EXPECT_EQ(log_, (std::vector<std::string>{"question@1000010", "answer@1000010", "timer@1000010"}));
}

class LiveExecutorTest : public testing::Test {
 protected:
  std::shared_ptr<lcm::LCM> transport_ = MakeTransport("memq://").lcm;
  LiveExecutor executor_{transport_};
};

TEST_F(LiveExecutorTest, RunsTimersUntilStopped) {
  int ticks = 0;
  executor_.Every(1000, [&] {
    if (++ticks == 5) executor_.Stop();
  });
  const Utime start = executor_.Now();
  executor_.Run();
  EXPECT_EQ(ticks, 5);
  EXPECT_GE(executor_.Now() - start, 4000);
}

TEST_F(LiveExecutorTest, EndsAtOnceWhenItWasStoppedBeforeItRan) {
  executor_.Stop();
  executor_.At(executor_.Now() + 20 * kSecond, [this] { executor_.Stop(); });  // should it not end by itself
  const Utime start = executor_.Now();
  executor_.Run();
  EXPECT_LT(executor_.Now() - start, 10 * kSecond);
}

TEST_F(LiveExecutorTest, RunsWhatAnotherThreadPosts) {
  const auto own = std::this_thread::get_id();
  std::thread::id ran_on;
  std::thread other([&] {
    executor_.Post([&] {
      ran_on = std::this_thread::get_id();
      executor_.Stop();
    });
  });
  executor_.Run();
  other.join();
  EXPECT_EQ(ran_on, own);
}

TEST_F(LiveExecutorTest, WatchesFileDescriptors) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  std::string got;
  executor_.Watch(ends[0], [&] {
    char letter = 0;
    ASSERT_EQ(read(ends[0], &letter, 1), 1);
    got += letter;
    if (got == "ab") {
      executor_.Unwatch(ends[0]);
      executor_.Stop();
    }
  });
  ASSERT_EQ(write(ends[1], "ab", 2), 2);
  executor_.Run();
  EXPECT_EQ(got, "ab");
  close(ends[0]);
  close(ends[1]);
}

TEST_F(LiveExecutorTest, EndsOnSigterm) {
  executor_.At(0, [] { kill(getpid(), SIGTERM); });
  executor_.Run();
  executor_.At(0, [&] { executor_.Stop(); });
  executor_.Run();  // the signal has been taken: this one ends by Stop
}

TEST_F(LiveExecutorTest, DeliversMessagesAndOutlivesACallbackThatThrows) {
  Bus bus(transport_, "node", executor_);
  Events events(bus);
  bus.Subscribe<event_t>(channel::kEvent, [&](const event_t&) { executor_.Stop(); });
  executor_.At(0, [] { throw std::runtime_error("on purpose"); });
  executor_.At(1, [&] { events.Tell(event_t::INFO, "code", "text"); });
  executor_.Run();
  EXPECT_EQ(bus.statistics().messages_in, 1);
}

}  // namespace
}  // namespace skein::bus
