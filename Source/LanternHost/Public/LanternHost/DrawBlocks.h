// The raster's objects, in blocks of up to 64 that lie close together: a view takes or leaves most blocks whole, and
// looks at single objects only in those that its edges cross. Centres are floats relative to the block, views are
// doubles: nothing is lost far from the origin.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "LanternRenderer/View.h"

namespace Lantern
{

/// Sphere around an object, in the world.
struct FDrawSphere
{
	glm::dvec3 Center{0};
	double Radius = 0.0; ///< infinite: never left out
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
	/// Items of a block that a view may see.
	struct FSeen
	{
		uint32_t Block = 0;
		float Distance = 0.0f; ///< to the block's centre
		uint64_t Items = 0;    ///< bit per item
	};

	/// Index in both: of the draw.
	void Build(const std::vector<FItem>& Items, const std::vector<FDrawSphere>& Spheres);
	void Move(uint32_t Draw, const FDrawSphere& Sphere);
	/// Blocks with something in view, near before far. Smaller than MinPixels across on the screen is not seen. Cheap: some
	/// hundredths of a millisecond for each 100,000 objects and core.
	void Collect(const FView& View, float MinPixels, std::vector<FSeen>& Out);
	const FBlock& GetBlock(uint32_t Index) const { return Blocks[Index]; }

private:
	struct FFrustum;
	/// Around all items of a block; apart from the blocks, since a view looks at all of them.
	struct FBounds
	{
		glm::dvec3 Center{0};
		float Radius = 0.0f; ///< grows with each item that moves …
		bool bStale = false; ///< … and waits to be measured anew
	};
	void Refresh(uint32_t Index);
	static bool MaySeeBlock(const FFrustum& Frustum, const FBounds& Bounds);
	static uint64_t CullItems(const FFrustum& Frustum, const FBlock& Block);

	std::vector<FBlock> Blocks;
	std::vector<uint32_t> Places; // of draws: block · Capacity + item
	std::vector<FBounds> Bounds;  // of Blocks
	std::vector<uint32_t> Stale;  // a queue, from NextStale on
	size_t NextStale = 0;
};

} // namespace Lantern
