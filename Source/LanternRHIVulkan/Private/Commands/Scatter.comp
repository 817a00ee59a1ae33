// Copies words all over a buffer, in items of at most WordsPerItem. Kind says what the items are.
// Records: item r of Source goes to record Items[r] of Dest.
// Handles: handle Items[r] of Source goes to record r of Dest, whose data stays.
// Regions: each item names its words itself.
// Mirrored by FVulkanScatter.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

const uint Records = 0, Handles = 1;

struct Region
{
	uint To, From, Words;
};

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint Item[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Regions { Region Item[]; };
layout(push_constant, scalar) uniform Push
{
	Words Dest;
	Words Source;
	Words Items;
	uint WordsPerItem;
	uint Count;
	uint DestWords; // from one record of Dest to the next
	uint Kind;
};

void main()
{
	for (uint i = gl_GlobalInvocationID.x; i < Count * WordsPerItem; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x)
	{
		const uint Item = i / WordsPerItem;
		const uint Word = i - Item * WordsPerItem;
		Region At;
		if (Kind == Records) { At = Region(Items.Item[Item] * DestWords, Item * WordsPerItem, WordsPerItem); }
		else if (Kind == Handles) { At = Region(Item * DestWords, Items.Item[Item] * WordsPerItem, WordsPerItem); }
		else { At = Regions(Items).Item[Item]; }
		if (Word < At.Words) { Dest.Item[At.To + Word] = Source.Item[At.From + Word]; }
	}
}
