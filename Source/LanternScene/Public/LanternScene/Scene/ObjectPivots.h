// How far away from objects' own origins (pivots) rays meet them. A driver turns rays into an object's space, by a translation
// as large as the pivot is far away from the scene's origin; what fp32 loses there does not show in the coordinates of the hit,
// as for a terrain in one piece. Shaders leave surfaces by more where some object is like that (Math.glsl, OffsetRayOrigin).
//
// Only objects that reach farther than LeastReach from their pivots are kept. A change costs O(1), unless it is of the very
// object that decides; an origin that moves costs a look at all that are kept.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

namespace Lantern
{

class FObjectPivots
{
public:
	static constexpr double LeastReach = 8.0; ///< metres

	/// Sphere: around the object, in the world; Radius < 0: unknown, and the object is taken to be small.
	void Set(uint32_t Object, const glm::dvec3& Pivot, const glm::dvec3& Center, double Radius);
	void Remove(uint32_t Object);
	void Update(const glm::dvec3& Origin);
	/// As of Update and the changes since; largest over all objects of min(distance of the pivot from the origin, distance of
	/// the object's farthest point from its pivot), where no point of the object is as far away from the origin itself. Metres,
	/// maximum norm; at least LeastReach.
	float GetReach() const { return static_cast<float>(Reach); }

private:
	struct FPivot
	{
		glm::dvec3 Pivot{0}, Center{0};
		double Radius = 0.0;
		double Farthest = 0.0; // of its points from the pivot
		uint32_t Object = 0;
	};
	double Measure(const FPivot& Pivot) const;

	std::vector<FPivot> Pivots;
	std::unordered_map<uint32_t, uint32_t> Places; // by object
	glm::dvec3 Origin{0};
	double Reach = LeastReach;
	bool bStale = false;
};

} // namespace Lantern
