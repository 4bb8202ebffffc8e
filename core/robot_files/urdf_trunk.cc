// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/urdf_trunk.h"

#include <algorithm>
#include <vector>

#include <urdf_model/model.h>

namespace scoria::core {
namespace {

/// From the root down to the link.
std::vector<urdf::LinkConstSharedPtr> Lineage(const urdf::ModelInterface& model,
                                              const std::string& link) {
  std::vector<urdf::LinkConstSharedPtr> out;
  for (auto at = model.getLink(link); at; at = at->getParent()) out.push_back(at);
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace

urdf::LinkConstSharedPtr FindTrunk(const urdf::ModelInterface& model,
                                   const std::array<std::string, 4>& haa_joints) {
  std::vector<urdf::LinkConstSharedPtr> shared;
  for (const std::string& joint : haa_joints) {
    auto lineage = Lineage(model, model.getJoint(joint)->parent_link_name);
    if (joint == haa_joints.front()) shared = lineage;
    const auto end = std::mismatch(shared.begin(), shared.end(), lineage.begin(), lineage.end());
    shared.erase(end.first, shared.end());
  }
  return shared.empty() ? model.getRoot() : shared.back();
}

bool IsBare(const urdf::Link& link, const urdf::Link* without) {
  if ((link.inertial && link.inertial->mass != 0.0) || !link.collision_array.empty()) return false;
  return std::ranges::all_of(link.child_links, [&](const urdf::LinkSharedPtr& child) {
    return child.get() == without || IsBare(*child, without);
  });
}

double FixedMass(const urdf::Link& link, const urdf::Link* without) {
  double mass_kg = link.inertial ? link.inertial->mass : 0.0;
  for (const urdf::LinkSharedPtr& child : link.child_links) {
    if (child->parent_joint->type == urdf::Joint::FIXED && child.get() != without)
      mass_kg += FixedMass(*child, without);
  }
  return mass_kg;
}

}  // namespace scoria::core
