// Marks threads whose slots a round updates; Order.comp lists them. Included behind RadianceCellSlots.glsl.

#define MARK_GROUP_SIZE GROUP_SIZE
#include "../Library/MarkBits.glsl"

// Turn: another one for each time that a cell is asked for.
bool IsTakenByChance(FRadianceGrid Grid, FRadianceCell Cell, uint Turn, float Share)
{
	return float(HashPcg(RadianceSeed(Grid, Cell) ^ HashPcg(Turn)) >> 8u) * (1.0 / 16777216.0) < Share;
}

// All threads of a work group call it once.
void MarkSlot(FRadianceGrid Grid, bool bListed)
{
	uint Bits, Lane = gl_LocalInvocationIndex;
	if (MarkBits(bListed, Bits)) { FRadianceWordRef(Grid.Marks).Data[(GetThread() - Lane) / 32u + Lane] = Bits; }
}
