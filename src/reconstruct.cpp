// SPDX-License-Identifier: GPL-3.0-or-later
#include <pcl/surface/floater/reconstruct.h>

namespace pcl
{
namespace floater
{
Result
reconstruct (Input, const Options&)
{
  return {};
}
} // namespace floater
} // namespace pcl
