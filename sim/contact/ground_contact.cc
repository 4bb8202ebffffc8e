// SPDX-License-Identifier: BSD-3-Clause
#include "sim/contact/ground_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include "sim/bullet_vectors.h"

namespace scoria::sim {
namespace {

/// Highest ground in square blocks of the grid, to see quickly that a body is well above it.
class CeilingMap {
 public:
  explicit CeilingMap(const terrains::Heightfield& ground)
      : blocks_((ground.nodes() + kBlock - 1) / kBlock),
        block_m_(kBlock * ground.resolution_m()),
        half_m_(ground.half_size_m()),
        highest_m_(static_cast<std::size_t>(blocks_ * blocks_), ground.min_m()) {
    for (int row = 0; row < ground.nodes(); ++row) {
      for (int column = 0; column < ground.nodes(); ++column) {
        // Nodes on a block's edge belong to the triangles of both neighbours.
        for (const int r : {std::max(row - 1, 0), row}) {
          for (const int c : {std::max(column - 1, 0), column}) {
            double& highest = highest_m_[Index(r / kBlock, c / kBlock)];
            highest = std::max(highest, ground.NodeHeight(column, row));
          }
        }
      }
    }
  }

  [[nodiscard]] double HighestIn(const btVector3& low, const btVector3& high) const {
    double highest = -1e30;
    for (int r = Block(low.y()); r <= Block(high.y()); ++r) {
      for (int c = Block(low.x()); c <= Block(high.x()); ++c) {
        highest = std::max(highest, highest_m_[Index(r, c)]);
      }
    }
    return highest;
  }

 private:
  static constexpr int kBlock = 8;
  [[nodiscard]] int Block(double coordinate_m) const {
    return std::clamp(static_cast<int>((coordinate_m + half_m_) / block_m_), 0, blocks_ - 1);
  }
  [[nodiscard]] std::size_t Index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(blocks_) +
           static_cast<std::size_t>(column);
  }

  int blocks_;
  double block_m_, half_m_;
  std::vector<double> highest_m_;
};

}  // namespace

struct GroundShape {
  const terrains::Heightfield& surface;
  CeilingMap ceiling;
  explicit GroundShape(const terrains::Heightfield& ground) : surface(ground), ceiling(ground) {}
};

namespace {

/// The point of the surface nearest to `c`, by Gauss-Newton on its horizontal position.
struct Nearest {
  Vec3 p_W = Vec3::Zero();
  Vec3 n_W = Vec3::UnitZ();
  double squared_distance = 0.0;
};

/// From a start on the surface. Gauss-Newton alone diverges over bumps sharper than the foot, so a
/// step is halved until it brings the point nearer.
Nearest Descend(const terrains::Heightfield& ground, const Vec3& c, const Vec2& start) {
  constexpr int kIterations = 8, kHalvings = 4;
  constexpr double kConverged_m = 1e-9;
  Vec2 xy = start;
  terrains::Heightfield::Sample s = ground.At(xy.x(), xy.y());
  const auto squared_distance = [&c](const Vec2& p, double z_m) {
    return (c.head<2>() - p).squaredNorm() + (c.z() - z_m) * (c.z() - z_m);
  };
  double best = squared_distance(xy, s.z_m);
  for (int i = 0; i < kIterations; ++i) {
    const Vec2& g = s.gradient;
    const Vec2 descent = c.head<2>() - xy + g * (c.z() - s.z_m);
    Vec2 step = descent - g * (g.dot(descent) / (1.0 + g.squaredNorm()));  // (I + g gᵀ)⁻¹ descent
    if (step.squaredNorm() < kConverged_m * kConverged_m) break;
    bool nearer = false;
    for (int h = 0; h < kHalvings && !nearer; ++h, step *= 0.5) {
      const Vec2 trial = xy + step;
      const terrains::Heightfield::Sample t = ground.At(trial.x(), trial.y());
      const double distance = squared_distance(trial, t.z_m);
      nearer = distance < best;
      if (!nearer) continue;
      best = distance;
      xy = trial;
      s = t;
    }
    if (!nearer) break;
  }
  return {Vec3(xy.x(), xy.y(), s.z_m), Vec3(-s.gradient.x(), -s.gradient.y(), 1.0).normalized(),
          best};
}

/// From below the sphere; and from a reach to each side where the ground there rises above the
/// sphere's lowest point, since level ground below knows nothing of a wall beside it.
Nearest FindNearest(const terrains::Heightfield& ground, const Vec3& c, double radius_m,
                    double reach_m) {
  Nearest nearest = Descend(ground, c, c.head<2>());
  for (const Vec2& side : {Vec2(1.0, 0.0), Vec2(-1.0, 0.0), Vec2(0.0, 1.0), Vec2(0.0, -1.0)}) {
    const Vec2 start = c.head<2>() + reach_m * side;
    if (ground.HeightAt(start.x(), start.y()) < c.z() - radius_m) continue;
    const Nearest other = Descend(ground, c, start);
    if (other.squared_distance < nearest.squared_distance) nearest = other;
  }
  return nearest;
}

class SphereGroundAlgorithm : public btActivatingCollisionAlgorithm {
 public:
  SphereGroundAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                        const btCollisionObjectWrapper* first,
                        const btCollisionObjectWrapper* second, bool ground_first,
                        const GroundShape& ground)
      : btActivatingCollisionAlgorithm(info, first, second),
        manifold_(info.m_manifold),
        ground_first_(ground_first),
        ground_(ground) {
    if (manifold_ == nullptr) {
      const auto* sphere = ground_first ? second : first;
      const auto* terrain = ground_first ? first : second;
      manifold_ =
          m_dispatcher->getNewManifold(sphere->getCollisionObject(), terrain->getCollisionObject());
      owned_ = true;
    }
  }
  ~SphereGroundAlgorithm() override {
    if (owned_) m_dispatcher->releaseManifold(manifold_);
  }

  void processCollision(const btCollisionObjectWrapper* first,
                        const btCollisionObjectWrapper* second, const btDispatcherInfo&,
                        btManifoldResult* result) override {
    const auto* sphere = ground_first_ ? second : first;
    const btVector3 centre = sphere->getWorldTransform().getOrigin();
    const Vec3 c(centre.x(), centre.y(), centre.z());
    const double radius =
        static_cast<const btSphereShape*>(sphere->getCollisionShape())->getRadius();
    result->setPersistentManifold(manifold_);
    manifold_->clearManifold();
    const double threshold = manifold_->getContactBreakingThreshold();
    const double reach = radius + threshold;
    const btVector3 span(reach, reach, 0.0);
    constexpr double kOvershoot_m = 0.01;  // of the bicubic surface over its nodes
    if (c.z() - reach > ground_.ceiling.HighestIn(centre - span, centre + span) + kOvershoot_m)
      return;

    const Nearest nearest = FindNearest(ground_.surface, c, radius, reach);
    const btVector3 n = ToBullet(nearest.n_W), p = ToBullet(nearest.p_W);
    const double distance = (c - nearest.p_W).dot(nearest.n_W) - radius;
    if (distance > threshold) return;
    // The normal must point from the manifold's second body to its first.
    if (manifold_->getBody0() == sphere->getCollisionObject()) {
      result->addContactPoint(n, p, distance);
    } else {
      result->addContactPoint(-n, p + n * distance, distance);
    }
  }

  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1.0;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (owned_) manifolds.push_back(manifold_);
  }

 private:
  btPersistentManifold* manifold_;
  bool owned_ = false;
  bool ground_first_;
  const GroundShape& ground_;
};

/// Bullet's convex-against-triangles test, skipped while the convex body is above everything below
/// it.
class BodyGroundAlgorithm : public btConvexConcaveCollisionAlgorithm {
 public:
  BodyGroundAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                      const btCollisionObjectWrapper* first, const btCollisionObjectWrapper* second,
                      bool ground_first, const GroundShape& ground)
      : btConvexConcaveCollisionAlgorithm(info, first, second, ground_first),
        ground_first_(ground_first),
        ceiling_(ground.ceiling) {}

  void processCollision(const btCollisionObjectWrapper* first,
                        const btCollisionObjectWrapper* second, const btDispatcherInfo& info,
                        btManifoldResult* result) override {
    const auto* body = ground_first_ ? second : first;
    btVector3 low, high;
    body->getCollisionShape()->getAabb(body->getWorldTransform(), low, high);
    if (low.z() > ceiling_.HighestIn(low, high) + gContactBreakingThreshold) {
      clearCache();
      return;
    }
    btConvexConcaveCollisionAlgorithm::processCollision(first, second, info, result);
  }

 private:
  bool ground_first_;
  const CeilingMap& ceiling_;
};

// Bullet's pool of algorithms has room for its own largest one in each place.
static_assert(std::max(sizeof(SphereGroundAlgorithm), sizeof(BodyGroundAlgorithm)) <=
              sizeof(btCompoundCompoundCollisionAlgorithm));

/// Makes algorithms of one kind.
template <class Algorithm>
class Factory : public btCollisionAlgorithmCreateFunc {
 public:
  Factory(const GroundShape& ground, bool ground_first)
      : ground_(ground), ground_first_(ground_first) {}
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* first,
                                                 const btCollisionObjectWrapper* second) override {
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Algorithm));
    return new (memory) Algorithm(info, first, second, ground_first_, ground_);
  }

 private:
  const GroundShape& ground_;
  bool ground_first_;
};

}  // namespace

struct GroundContact::Impl {
  explicit Impl(std::shared_ptr<const GroundShape> shape_in)
      : shape(std::move(shape_in)),
        foot_first(*shape, false),
        ground_foot(*shape, true),
        body_first(*shape, false),
        ground_body(*shape, true) {}
  std::shared_ptr<const GroundShape> shape;
  Factory<SphereGroundAlgorithm> foot_first, ground_foot;
  Factory<BodyGroundAlgorithm> body_first, ground_body;
};

std::shared_ptr<const GroundShape> MakeGroundShape(const terrains::Heightfield& ground) {
  return std::make_shared<const GroundShape>(ground);
}

GroundContact::GroundContact(btCollisionDispatcher& dispatcher,
                             std::shared_ptr<const GroundShape> shape)
    : impl_(std::make_unique<Impl>(std::move(shape))) {
  constexpr int kGround = TERRAIN_SHAPE_PROXYTYPE;
  dispatcher.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, kGround, &impl_->foot_first);
  dispatcher.registerCollisionCreateFunc(kGround, SPHERE_SHAPE_PROXYTYPE, &impl_->ground_foot);
  for (const int body :
       {BOX_SHAPE_PROXYTYPE, CAPSULE_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE}) {
    dispatcher.registerCollisionCreateFunc(body, kGround, &impl_->body_first);
    dispatcher.registerCollisionCreateFunc(kGround, body, &impl_->ground_body);
  }
}

GroundContact::~GroundContact() = default;

const std::shared_ptr<const GroundShape>& GroundContact::shape() const noexcept {
  return impl_->shape;
}

}  // namespace scoria::sim
