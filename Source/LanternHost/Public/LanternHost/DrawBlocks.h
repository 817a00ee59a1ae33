// Groups the raster's objects in blocks of up to 64 that lie close together. Culling accepts or rejects most blocks whole, and
// tests single objects only in blocks that cross the border of the view. Centres are floats relative to the block and views
// are doubles, so that precision does not degrade far from the origin.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "LanternRenderer/View.h"

namespace Lantern
{

/// Bounding sphere of an object, in world space.
struct FDrawSphere
{
	glm::dvec3 Center{0};
	double Radius = 0.0; ///< infinite: never culled
	bool bMirrored = false;
};

class FDrawBlocks
{
public:
	struct FItem
	{
		uint32_t Object = 0; ///< index into FObjectData[]
		uint32_t FirstBatch = 0, BatchCount = 0;
	};
	struct FBlock
	{
		static constexpr uint32_t Capacity = 64;

		alignas(64) float X[Capacity] = {}, Y[Capacity] = {}, Z[Capacity] = {}, R[Capacity] = {}; ///< relative to Center
		FItem Items[Capacity];
		uint64_t Mirrored = 0; ///< bit per item
		uint32_t Count = 0;
		glm::dvec3 Center{0};
	};
	/// A block that a view may see, with its visible items.
	struct FSeen
	{
		uint32_t Block = 0;
		float Distance = 0.0f; ///< to the block's centre
		uint64_t Items = 0;    ///< bit per item
	};

	/// Builds the blocks. The index into both arrays is that of the draw.
	void Build(const std::vector<FItem>& Items, const std::vector<FDrawSphere>& Spheres);
	void Move(uint32_t Draw, const FDrawSphere& Sphere);
	/// Collects blocks with something in view, near before far. Objects smaller than MinPixels across on the screen are culled.
	/// Takes some hundredths of a millisecond for each 100,000 objects and core.
	void Collect(const FView& View, float MinPixels, std::vector<FSeen>& Out);
	/// Widens the range Min to Max until it holds all spheres along Axis, which has unit length. Those that are infinite do not count.
	void AddExtent(const glm::dvec3& Axis, double& Min, double& Max) const;
	const FBlock& GetBlock(uint32_t Index) const { return Blocks[Index]; }
	/// Returns whether some draw is mirrored, or was since Build.
	bool HasMirrored() const { return bMirrored; }

private:
	struct FFrustum;
	/// Bounds of a block's items. They are stored apart from the blocks, since culling reads all of them.
	struct FBounds
	{
		glm::dvec3 Center{0};
		float Radius = 0.0f; ///< grows with each item that moves
		bool bStale = false; ///< Radius is to be recomputed
	};
	void Refresh(uint32_t Index);
	static bool MaySeeBlock(const FFrustum& Frustum, const FBounds& Bounds);
	static uint64_t CullItems(const FFrustum& Frustum, const FBlock& Block);

	std::vector<FBlock> Blocks;
	std::vector<uint32_t> Places; // of draws: block · Capacity + item
	std::vector<FBounds> Bounds;  // of Blocks
	std::vector<uint32_t> Stale;  // a queue, from NextStale on
	size_t NextStale = 0;
	bool bMirrored = false;
};

} // namespace Lantern
