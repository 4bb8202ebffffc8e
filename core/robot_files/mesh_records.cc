// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/mesh_records.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/files.h"
#include "core/robot_files/mesh.h"

namespace scoria::core {

std::set<std::filesystem::path> MeshFiles(const RobotDescription& robot) {
  std::set<std::filesystem::path> files;
  for (const std::vector<Shape>* shapes : {&robot.collisions, &robot.visuals}) {
    for (const Shape& shape : *shapes) {
      if (!shape.mesh.empty()) files.insert(shape.mesh);
    }
  }
  return files;
}

MeshRecords RecordMeshes(const RobotDescription& robot) {
  MeshRecords records;
  for (const std::vector<Shape>* shapes : {&robot.collisions, &robot.visuals}) {
    for (const Shape& shape : *shapes) {
      if (shape.mesh.empty() || records.contains(shape.mesh_name)) continue;
      const auto solid = CalcMeshSolid(shape.mesh);
      const auto hash = HashFile(shape.mesh);
      if (solid && hash) records[shape.mesh_name] = {solid->bounds, *hash, solid->hull};
    }
  }
  return records;
}

std::vector<std::string> DrawLostMeshesAsBoxes(RobotDescription& robot) {
  std::vector<std::string> remarks;
  for (Shape& shape : robot.visuals) {
    const auto record = robot.meshes.find(shape.mesh_name);
    if (shape.kind != Shape::Kind::kMesh || record == robot.meshes.end()) continue;
    const auto hash = HashFile(shape.mesh);
    if (hash == record->second.hash) continue;
    const MeshBounds bounds = Scaled(record->second.bounds, shape.size_m);
    shape.kind = Shape::Kind::kBox;
    shape.size_m = bounds.high - bounds.low;
    shape.p_LG += shape.R_LG * (0.5 * (bounds.low + bounds.high));
    const std::string remark = fmt::format("mesh {} {}; its box is drawn", shape.mesh.string(),
                                           hash ? "has changed since the walk" : "is gone");
    if (std::ranges::count(remarks, remark) == 0) remarks.push_back(remark);
  }
  return remarks;
}

}  // namespace scoria::core
