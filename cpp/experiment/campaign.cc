#include "experiment/campaign.h"

#include <atomic>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "config/variation.h"
#include "experiment/experiment.h"

namespace skein::experiment {
namespace {

class Flights {
 public:
  Flights(const config::Scenario& scenario, const CampaignOptions& options)
      : scenario_(scenario), options_(options) {}

  void Fly() {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < options_.jobs; ++i) threads.emplace_back([this] { FlyRuns(); });
    threads.clear();
    for (const auto& [index, row] : waiting_) {
      if (options_.on_row) options_.on_row(row);
    }
    if (!failure_.empty()) throw std::runtime_error(failure_);
  }

 private:
  bool IsOver() const { return failed_ || (options_.stop && options_.stop()); }

  void FlyRuns() {
    while (!IsOver()) {
      const std::uint64_t index = next_run_++;
      if (index >= options_.runs) return;
      try {
        const auto row = FlyRun(options_.first_seed + index);
        if (row) Take(index, *row);
      } catch (const std::exception& error) {
        Fail(options_.first_seed + index, error.what());
      }
    }
  }

  /// None when it was ended early.
  std::optional<CampaignRow> FlyRun(std::uint64_t seed) const {
    bool is_whole = true;
    ExperimentOptions options;
    options.seed = seed;
    options.duration_s = options_.duration_s;
    options.logs = options_.logs;
    options.stop = [&] {
      is_whole = !IsOver();
      return !is_whole;
    };
    const Summary summary = RunExperiment(config::Varied(scenario_, seed), options);
    return is_whole ? std::optional(RowOf(seed, summary)) : std::nullopt;
  }

  void Take(std::uint64_t index, const CampaignRow& row) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(index, row);
    while (!waiting_.empty() && waiting_.begin()->first == next_row_) {
      if (options_.on_row) options_.on_row(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
      ++next_row_;
    }
    ++flown_;
    if (options_.on_progress) options_.on_progress(flown_);
  }

  void Fail(std::uint64_t seed, const std::string& reason) {
    const std::lock_guard lock(mutex_);
    if (failure_.empty()) failure_ = "seed " + std::to_string(seed) + ": " + reason;
    failed_ = true;
  }

  const config::Scenario& scenario_;
  const CampaignOptions& options_;
  std::atomic<std::uint64_t> next_run_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;                              // for all below
  std::map<std::uint64_t, CampaignRow> waiting_;  // for an earlier one
  std::uint64_t next_row_ = 0;
  std::uint64_t flown_ = 0;
  std::string failure_;
};

}  // namespace

void FlyCampaign(const config::Scenario& scenario, const CampaignOptions& options) {
  Flights(scenario, options).Fly();
}

}  // namespace skein::experiment
