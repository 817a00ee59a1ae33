// Step "even" of the temporal filter, for visibility whose transitions have extents: finds groups that are all lit or all dark.
//   Takes: the values of the group's pixels and of those around it, one by one, from Load.glsl.
//   Gives: IsEven, after a barrier behind the last value.
//   Why: nothing in such a group has noise, and neighbours tell nothing. Most groups of a picture are even, and take half the time.
#ifndef LANTERN_TEMPORAL_EVEN_GLSL
#define LANTERN_TEMPORAL_EVEN_GLSL

#if CHANNELS == 1 && defined(WITH_EXTENT)
#define FINDS_EVEN
const uint NotLit = 1u, NotDark = 2u;
shared uint Differs; // what some pixel is

// A barrier follows.
void StartEven()
{
	if (gl_LocalInvocationIndex == 0u) { Differs = 0u; }
}

// Value: of a pixel with a surface. What only stands for a value is negative, and neither lit nor dark.
uint CompareValue(float Value) { return (Value == 1.0 ? 0u : NotLit) | (Value == 0.0 ? 0u : NotDark); }

// Mine: CompareValue of all pixels that a thread has loaded.
void NoteValues(uint Mine)
{
	if (Mine != 0u) { atomicOr(Differs, Mine); }
}

bool IsEven() { return Differs != (NotLit | NotDark); }
FSignal GetEvenValue() { return (Differs & NotDark) != 0u ? 1.0 : 0.0; }
#endif

#endif
