// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Progress and interruption of a run that Python has called.
#pragma once

#include <pcl/surface/floater/options.h>
#include <pcl/surface/floater/texture_coordinates.h>

#include <pybind11/pybind11.h>

#include <exception>
#include <type_traits>
#include <utility>

namespace pcl::floater {
/// Tells Python's caller how far a run is, and ends the run if the callable or a signal raised an
/// exception. The run does not hold the lock of the interpreter (GIL) meanwhile.
class Watch
{
public:
  explicit Watch (pybind11::object progress) : progress_ (std::move (progress))
  {
    // Signals are handled in the main thread only.
    const auto threading = pybind11::module_::import ("threading");
    handles_signals_ = threading.attr ("current_thread") ().is (threading.attr ("main_thread") ());
  }

  /// \param options Options, or TextureOptions
  template <typename AnyOptions>
  void attachTo (AnyOptions& options)
  {
    options.cancelled_callback = [this] { return isCancelled (); };
    if (!progress_.is_none ())
      options.progress_callback = [this] (double fraction) { tell (fraction); };
    if constexpr (std::is_same_v<AnyOptions, Options>)
      options.stage_callback = [this] (Stage stage) { stage_ = stageName (stage); };
    else
      stage_ = "texture";
  }

  /// To be called with the lock.
  /// \throws what was raised during the run
  void rethrow () const
  {
    if (raised_)
      std::rethrow_exception (raised_);
  }

private:
  void tell (double fraction)
  {
    if (raised_)
      return;
    const pybind11::gil_scoped_acquire lock;
    try {
      progress_ (stage_, fraction);
    }
    catch (const pybind11::error_already_set&) {
      raised_ = std::current_exception ();
    }
  }

  bool isCancelled ()
  {
    if (!raised_ && handles_signals_) {
      const pybind11::gil_scoped_acquire lock;
      if (PyErr_CheckSignals () != 0)
        raised_ = std::make_exception_ptr (pybind11::error_already_set ());
    }
    return raised_ != nullptr;
  }

  pybind11::object progress_;
  bool handles_signals_ = false;
  const char* stage_ = "";
  std::exception_ptr raised_;
};

} // namespace pcl::floater
