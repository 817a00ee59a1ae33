// Lists of threads: passes mark who goes on, OrderThreads.comp lists them, and a later launch has a thread for each (FThreadList).
#ifndef LANTERN_THREAD_LIST_GLSL
#define LANTERN_THREAD_LIST_GLSL

#include "../Library/Bindings.glsl"
#include "../Shared/RayQueueTypes.h"
#include "../Shared/ThreadListTypes.h"

// Words: BitWords of marks, and then entries.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FThreadListRef
{
	FThreadList Header;
	uint Words[];
};

// Returns the bit of a thread of a launch that is so wide. Tiles of threads follow one another.
uint BitOfThread(uvec2 Thread, uint Width)
{
	uvec2 Tile = Thread / THREAD_TILE, Inside = Thread % THREAD_TILE;
	return (Tile.y * ((Width + THREAD_TILE - 1u) / THREAD_TILE) + Tile.x) * (THREAD_TILE * THREAD_TILE) + Inside.y * THREAD_TILE + Inside.x;
}
uvec2 ThreadOfBit(uint Bit, uint Width)
{
	uint Columns = (Width + THREAD_TILE - 1u) / THREAD_TILE, Tile = Bit / (THREAD_TILE * THREAD_TILE), Inside = Bit % (THREAD_TILE * THREAD_TILE);
	return uvec2(Tile % Columns, Tile / Columns) * THREAD_TILE + uvec2(Inside % THREAD_TILE, Inside / THREAD_TILE);
}

void MarkThread(FAddress List, uint Bit) { atomicOr(FThreadListRef(List).Words[Bit >> 5u], 1u << (Bit & 31u)); }

// Number: of the launch's thread. OutThread: the one that it runs, or its number row by row. Launches may be larger than their list.
bool FindThread(FAddress List, uint Number, out uint OutThread)
{
	OutThread = 0u;
	FThreadList Header = FThreadListRef(List).Header;
	if (Number >= Header.Launch[0]) { return false; }
	OutThread = FThreadListRef(List).Words[Header.BitWords + Number];
	return true;
}

#endif
