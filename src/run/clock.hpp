#pragma once
/// Simulated time: steps that end exactly where something is due.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "run/options.hpp"

namespace mudlark {

class Clock {
 public:
  /// Things fall due every `periods` seconds, and at `times`; `end` closes the run. Steps end at
  /// `bends`, too, ascending: what drives the run changes there.
  Clock(const TimeOptions& options, std::vector<double> periods, std::vector<double> bends = {})
      : options_(options), periods_(std::move(periods)), bends_(std::move(bends)) {
    if (options.output_every > 0.0) periods_.push_back(options.output_every);
  }

  double time() const { return time_; }
  std::int64_t step() const { return step_; }
  bool finished() const { return stopped_ || time_ >= options_.end; }
  /// Where the run is in its stages.
  std::size_t stage() const { return static_cast<std::size_t>(stage_); }
  bool in_last_stage() const { return stage() + 1 >= options_.stage_ends.size(); }
  /// Is the next stage to begin before the next step?
  bool stage_over() const { return !in_last_stage() && time_ >= options_.stage_ends[stage()]; }
  void begin_next_stage() { ++stage_; }
  /// Goes to the end of the stage at once: nothing happens until then.
  void pass_to_stage_end() { time_ = std::min(options_.stage_ends[stage()], options_.end); }
  bool at_stage_end() const { return is_one_of(options_.stage_ends); }

  /// Closes the run now, before its end. Not part of the state: a continued run goes on.
  void stop() { stopped_ = true; }
  bool stopped() const { return stopped_; }

  /// Is something that repeats every `period` due now? Period 0: always.
  static bool due(double time, double period) {
    if (period <= 0.0) return true;
    const double count = time / period;
    return std::abs(count - std::round(count)) < 1e-9 * std::max(1.0, count);
  }
  bool output_due() const {
    if (finished() || time_ == 0.0) return true;
    if (options_.output_every > 0.0 && due(time_, options_.output_every)) return true;
    return at_stage_end() || is_one_of(options_.output_at);
  }

  /// Next time at which something is due [s]. Times as the user wrote them are met exactly;
  /// multiples of a period that mean the same (3 * 0.3 is not 0.9 in floating point) make no step
  /// of their own.
  double next_event() const {
    double next = options_.end;
    for (const double t : options_.output_at)
      if (t > time_) next = std::min(next, t);
    for (const double t : options_.stage_ends)
      if (t > time_) next = std::min(next, t);
    const double written = next;
    for (const double period : periods_) {
      const double count = time_ / period;
      const double passed = std::floor(count + 1e-9 * std::max(1.0, count));
      const double multiple = (passed + 1.0) * period;
      if (multiple < written - 1e-9 * period) next = std::min(next, multiple);
    }
    const auto bend = std::upper_bound(bends_.begin(), bends_.end(), time_ * (1.0 + 1e-9));
    if (bend != bends_.end() && *bend < next * (1.0 - 1e-9)) next = *bend;
    return next;
  }
  /// Step no longer than `stable`, so that equal steps reach the next event exactly [s].
  double choose_step(double stable) const {
    double limit = std::min(stable, options_.max_step.value_or(std::numeric_limits<double>::max()));
    if (options_.step) limit = *options_.step;
    const double remaining = next_event() - time_;
    return remaining / std::max(1.0, std::ceil(remaining / limit * (1.0 - 1e-12)));
  }
  void advance(double dt) {
    const double event = next_event();
    time_ += dt;
    if (std::abs(time_ - event) < 1e-9 * dt) time_ = event;
    ++step_;
  }

  template <class Archive>
  void archive(Archive& a) {
    a.number("clock/time", time_);
    a.integer("clock/step", step_);
    a.integer("clock/stage", stage_);
  }

 private:
  bool is_one_of(const std::vector<double>& times) const {
    return std::find(times.begin(), times.end(), time_) != times.end();
  }

  TimeOptions options_;
  std::vector<double> periods_, bends_;
  double time_ = 0.0;
  std::int64_t step_ = 0, stage_ = 0;
  bool stopped_ = false;
};

}  // namespace mudlark
