// FCasterChanges tells where shadows may have changed: which casters moved, came, went, changed their shape or were deformed, with
// their bounds before and after. Whoever keeps shadows from frame to frame asks for what changed since a frame of its own.
//
// A note costs O(1) and no memory but that of the last MostKept notes, which is allocated with the first one. Threads: one at a time.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace Lantern
{

struct FCasterChange
{
	glm::dvec3 From{0}, To{0}; ///< centres of the bounding sphere before and after, in the world
	double Radius = 0.0;       ///< of the larger sphere, metres
	double Changed = 1.0;      ///< about the part of what it hides, or of how it looks, that is new: 0 to 1
	uint32_t Object = 0;       ///< its slot, FRTObjectId::Index
	double Emission = 0.0;     ///< mean luminance of what it emits, nits; with FAppearanceChanges: if that has changed
	bool bCasts = true;        ///< its shadow may have changed; false with FAppearanceChanges, once both are in one list
};

class FCasterChanges
{
public:
	static constexpr uint32_t MostKept = 4096;

	/// A sphere that is not finite may be anywhere.
	void Add(const FCasterChange& Change);
	/// Notes a change that may have moved any shadow.
	void AddAnywhere();
	/// Returns how many changes were noted so far.
	uint64_t GetCount() const { return Count; }
	/// Sets Out to the changes after the first Since. False: they are too many, or some may be anywhere. Since ≤ GetCount().
	bool Find(uint64_t Since, std::vector<FCasterChange>& Out) const;

private:
	std::vector<FCasterChange> Last; // ring of the last MostKept; entry I holds change I modulo MostKept
	uint64_t Count = 0;
	uint64_t Anywhere = 0; // value of Count behind the last AddAnywhere
};

struct FAppearanceChange
{
	double Part = 0.0;     ///< of the light that the surface reflects or emits, 0 to 1
	double Emission = 0.0; ///< greater luminance of what it emits, nits, if that has changed; else 0
};
/// Tells which objects look otherwise than before and thus reflect or emit other light: a material's colour, maps or emission is
/// another one. No shadow has changed by that.
class FAppearanceChanges
{
public:
	/// What more objects share has changed everywhere at once.
	static constexpr uint32_t MostObjects = 256;

	void Add(const FCasterChange& Change) { Objects.Add(Change); }
	void AddEverywhere(double Change) { Everywhere += Change; }
	const FCasterChanges& GetObjects() const { return Objects; }
	/// Returns the sum of all changes without a place of their own so far.
	double GetEverywhere() const { return Everywhere; }

private:
	FCasterChanges Objects;
	double Everywhere = 0.0;
};

} // namespace Lantern
