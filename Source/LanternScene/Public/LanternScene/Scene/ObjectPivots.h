// FObjectPivots finds how far from their own origins (pivots) rays meet objects. A driver moves rays into an object's
// space, by a translation as long as the pivot is far from the scene's origin. The precision that fp32 loses there does not
// show in the coordinates of the hit. A terrain in one piece is an example. Shaders offset ray origins by more if a scene has
// such an object (Math.glsl, OffsetRayOrigin).
//
// Only objects that reach farther than LeastReach from their pivots are kept. A change costs O(1), unless it lessens the
// object that decides. A moving origin costs O(objects kept).
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <glm/glm.hpp>

namespace Lantern
{

class FObjectPivots
{
public:
	static constexpr double LeastReach = 8.0; ///< metres

	/// Center and Radius give the bounding sphere in the world. Radius < 0: unknown; the object is taken to be small.
	void Set(uint32_t Object, const glm::dvec3& Pivot, const glm::dvec3& Center, double Radius);
	void Remove(uint32_t Object);
	void Update(const glm::dvec3& Origin);
	/// Returns the largest reach of an object, as of Update and the changes since; at least LeastReach. Metres, maximum norm.
	/// An object's reach is the lesser of two distances: pivot to origin, and pivot to the object's farthest point. Objects
	/// whose nearest point is at least that far from the origin do not count.
	float GetReach() const { return static_cast<float>(Reach); }

private:
	struct FPivot
	{
		glm::dvec3 Pivot{0}, Center{0};
		double Radius = 0.0;
		double Farthest = 0.0; // distance of a point of the object from the pivot
		uint32_t Object = 0;
	};
	static constexpr uint32_t NoPlace = ~0u;
	double Measure(const FPivot& Pivot) const;

	std::deque<FPivot> Pivots;   // grow without moving what is there
	std::deque<uint32_t> Places; // in Pivots, by object, or NoPlace
	glm::dvec3 Origin{0};
	double Reach = LeastReach;
	bool bStale = false;
};

} // namespace Lantern
