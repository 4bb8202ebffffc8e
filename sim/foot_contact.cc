// SPDX-License-Identifier: BSD-3-Clause
#include "sim/foot_contact.h"

#include <cmath>

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

namespace scoria::sim {
namespace {

/// The point of the surface nearest to `c`, by Gauss-Newton on its horizontal position.
struct Nearest {
  Vec3 p_W = Vec3::Zero();
  Vec3 n_W = Vec3::UnitZ();
};

Nearest FindNearest(const terrains::Heightfield& ground, const Vec3& c) {
  constexpr int kIterations = 4;
  constexpr double kConverged_m = 1e-9;
  Vec2 xy = c.head<2>();
  terrains::Heightfield::Sample s = ground.At(xy.x(), xy.y());
  for (int i = 0; i < kIterations; ++i) {
    const Vec2& g = s.gradient;
    const Vec2 descent = c.head<2>() - xy + g * (c.z() - s.z_m);
    const Vec2 step =
        descent - g * (g.dot(descent) / (1.0 + g.squaredNorm()));  // (I + g gᵀ)⁻¹ descent
    xy += step;
    s = ground.At(xy.x(), xy.y());
    if (step.squaredNorm() < kConverged_m * kConverged_m) break;
  }
  return {Vec3(xy.x(), xy.y(), s.z_m), Vec3(-s.gradient.x(), -s.gradient.y(), 1.0).normalized()};
}

btVector3 ToBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

class SphereGroundAlgorithm : public btActivatingCollisionAlgorithm {
 public:
  SphereGroundAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                        const btCollisionObjectWrapper* first,
                        const btCollisionObjectWrapper* second, bool ground_first,
                        const terrains::Heightfield& ground)
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
    const double above = c.z() - ground_.HeightAt(c.x(), c.y());
    constexpr double kSteepest = 4.0;  // no surface point is nearer than height / sqrt(1 + slope^2)
    if (above > (radius + threshold) * kSteepest) return;

    const Nearest nearest = FindNearest(ground_, c);
    const btVector3 n = ToBullet(nearest.n_W), p = ToBullet(nearest.p_W);
    const double distance = (c - nearest.p_W).dot(nearest.n_W) - radius;
    if (distance > threshold) return;
    // The normal must point from the manifold's second body to its first.
    if (manifold_->getBody0() == sphere->getCollisionObject()) {
      result->addContactPoint(n, p, distance);
    } else {
      result->addContactPoint(-n, p + n * distance, distance);
    }
    if (manifold_->getNumContacts() == 0) return;
    btManifoldPoint& point = manifold_->getContactPoint(0);
    point.m_combinedFriction = ground_.friction();
    point.m_userPersistentData =
        const_cast<terrains::Heightfield*>(&ground_);  // marks a foot contact
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
  const terrains::Heightfield& ground_;
};

class Factory : public btCollisionAlgorithmCreateFunc {
 public:
  Factory(const terrains::Heightfield& ground, bool ground_first)
      : ground_(ground), ground_first_(ground_first) {}
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* first,
                                                 const btCollisionObjectWrapper* second) override {
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(SphereGroundAlgorithm));
    return new (memory) SphereGroundAlgorithm(info, first, second, ground_first_, ground_);
  }

 private:
  const terrains::Heightfield& ground_;
  bool ground_first_;
};

}  // namespace

struct FootContact::Impl {
  Factory sphere_first, ground_first;
};

FootContact::FootContact(btCollisionDispatcher& dispatcher, const terrains::Heightfield& ground)
    : impl_(new Impl{{ground, false}, {ground, true}}) {
  dispatcher.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, TERRAIN_SHAPE_PROXYTYPE,
                                         &impl_->sphere_first);
  dispatcher.registerCollisionCreateFunc(TERRAIN_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE,
                                         &impl_->ground_first);
}

FootContact::~FootContact() = default;

}  // namespace scoria::sim
