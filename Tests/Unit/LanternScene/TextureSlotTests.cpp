// MakeTextureSlot: what fits comes back by the macros that shaders use, and nothing else is accepted.
#include <gtest/gtest.h>

#include "LanternScene/Scene/TextureSlot.h"

namespace Lantern
{
namespace
{

TEST(FTextureSlotTest, IndicesComeBack)
{
	for (const uint32_t Texture : {0u, 1u, 65535u, (1u << TEXTURE_INDEX_BITS) - 1})
	{
		for (const uint32_t Sampler : {0u, 255u, 256u, 300u, 1022u})
		{
			uint32_t Slot = NO_TEXTURE;
			ASSERT_TRUE(MakeTextureSlot(Texture, Sampler, Slot)) << Texture << ", " << Sampler;
			EXPECT_EQ(SLOT_TEXTURE(Slot), Texture);
			EXPECT_EQ(SLOT_SAMPLER(Slot), Sampler);
		}
	}
}

TEST(FTextureSlotTest, WhatDoesNotFitIsRefused)
{
	uint32_t Slot = 0;
	EXPECT_FALSE(MakeTextureSlot(~0u, 0, Slot)) << "not Sampled";
	EXPECT_EQ(Slot, NO_TEXTURE);
	EXPECT_FALSE(MakeTextureSlot(1u << TEXTURE_INDEX_BITS, 0, Slot));
	EXPECT_FALSE(MakeTextureSlot(0, 1024, Slot));
	EXPECT_FALSE(MakeTextureSlot((1u << TEXTURE_INDEX_BITS) - 1, 1023, Slot)) << "it would read as NO_TEXTURE";
}

} // namespace
} // namespace Lantern
