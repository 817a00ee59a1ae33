// Tables of intensity: whether they hold what they must, and regular grids of them.
#include "LanternScene/Lights/Photometry.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <string>

#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace
{
FRTStatus Refuse(std::string_view Name, const std::string& Message)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s: %s", EscapeText(Name, MaxQuotedBytes).c_str(), Message.c_str());
}

bool IsNear(float A, float B) { return std::abs(A - B) < 1e-3f; }

/// Returns the first angle that is not above the one before, or the count.
size_t FindUnsorted(const std::vector<float>& Angles)
{
	const auto Found = std::adjacent_find(Angles.begin(), Angles.end(), [](float A, float B) { return !(A < B); });
	return Found == Angles.end() ? Angles.size() : static_cast<size_t>(Found - Angles.begin()) + 1;
}

bool AreFinite(const std::vector<float>& Values)
{
	return std::all_of(Values.begin(), Values.end(), [](float Value) { return std::isfinite(Value); });
}

/// Returns the widest of some steps by which all angles can be reached, or the finest.
float FindStep(const std::vector<float>& Angles, std::initializer_list<float> Steps)
{
	const auto Fits = [&](float Step) {
		return std::all_of(Angles.begin(), Angles.end(), [&](float Angle) {
			const float Count = (Angle - Angles.front()) / Step;
			return std::abs(Count - std::round(Count)) < 1e-3f;
		});
	};
	const auto Found = std::find_if(Steps.begin(), Steps.end(), Fits);
	return Found == Steps.end() ? *std::prev(Steps.end()) : *Found;
}

/// A place between two entries of a list of angles.
struct FPlace
{
	size_t Low = 0, High = 0;
	float Share = 0.0f; ///< of High
};

FPlace Find(const std::vector<float>& Angles, float Angle)
{
	const auto Above = std::upper_bound(Angles.begin(), Angles.end(), Angle);
	if (Above == Angles.begin()) { return {}; }
	const auto Low = static_cast<size_t>(Above - Angles.begin()) - 1;
	if (Above == Angles.end()) { return {Low, Low, 0.0f}; }
	return {Low, Low + 1, (Angle - Angles[Low]) / (Angles[Low + 1] - Angles[Low])};
}

/// Returns the horizontal angle of the table that stands for one from 0 to 360.
float Fold(const std::vector<float>& Horizontal, float Angle)
{
	const float First = Horizontal.front(), Last = Horizontal.back();
	if (IsNear(First, 90.0f)) { return Angle < 90.0f ? 180.0f - Angle : Angle > 270.0f ? 540.0f - Angle : Angle; }
	if (IsNear(Last, 360.0f)) { return Angle; }
	const float Half = Angle > 180.0f ? 360.0f - Angle : Angle;
	return IsNear(Last, 90.0f) && Half > 90.0f ? 180.0f - Half : Half;
}

float Sample(const FPhotometry& Table, float Horizontal, float Vertical)
{
	const FPlace H = Find(Table.Horizontal, Horizontal), V = Find(Table.Vertical, Vertical);
	const auto Column = [&](size_t I) {
		const float* const Values = Table.Candela.data() + I * Table.Vertical.size();
		return std::lerp(Values[V.Low], Values[V.High], V.Share);
	};
	return std::lerp(Column(H.Low), Column(H.High), H.Share);
}
} // namespace

FRTStatus CheckPhotometry(const FPhotometry& Table, std::string_view Name)
{
	const auto& [Vertical, Horizontal, Candela] = Table;
	if (Vertical.size() < 2 || Horizontal.empty()) { return Refuse(Name, "a profile has 2 vertical angles and 1 horizontal one at least"); }
	if (Candela.size() != Vertical.size() * Horizontal.size())
	{
		return Refuse(Name, "a profile has not one intensity for each pair of angles");
	}
	if (!AreFinite(Vertical) || !AreFinite(Horizontal)) { return Refuse(Name, "an angle is not finite"); }
	if (const size_t I = FindUnsorted(Vertical); I < Vertical.size())
	{
		return Refuse(Name, "vertical angle " + std::to_string(I + 1) + " is not above the one before");
	}
	if (const size_t I = FindUnsorted(Horizontal); I < Horizontal.size())
	{
		return Refuse(Name, "horizontal angle " + std::to_string(I + 1) + " is not above the one before");
	}
	const bool bFirst = IsNear(Vertical.front(), 0.0f) || IsNear(Vertical.front(), 90.0f);
	const bool bLast = IsNear(Vertical.back(), 90.0f) || IsNear(Vertical.back(), 180.0f);
	if (!bFirst || !bLast) { return Refuse(Name, "vertical angles do not run from 0 or 90 to 90 or 180"); }
	const float From = Horizontal.front(), To = Horizontal.back();
	const bool bAround = IsNear(From, 0.0f) && (Horizontal.size() == 1 || IsNear(To, 90.0f) || IsNear(To, 180.0f) || IsNear(To, 360.0f));
	if (!bAround && !(IsNear(From, 90.0f) && IsNear(To, 270.0f)))
	{
		return Refuse(Name, "horizontal angles run neither from 0 to 0, 90, 180 or 360 nor from 90 to 270");
	}
	const auto IsIntensity = [](float C) { return std::isfinite(C) && C >= 0.0f; };
	const auto Bad = std::find_if_not(Candela.begin(), Candela.end(), IsIntensity);
	if (Bad != Candela.end())
	{
		return Refuse(Name, "intensity " + std::to_string(Bad - Candela.begin() + 1) + " is negative or not finite");
	}
	const bool bDark = std::all_of(Candela.begin(), Candela.end(), [](float C) { return C == 0.0f; });
	return bDark ? Refuse(Name, "all intensities are 0") : FRTStatus::Success();
}

FProfileGrid MakeProfileGrid(const FPhotometry& Table)
{
	assert(CheckPhotometry(Table, ""));
	FProfileGrid Out;
	const bool bAlike = Table.Horizontal.size() == 1;
	const float Step = FindStep(Table.Vertical, {10.0f, 5.0f, 2.5f, 2.0f, 1.0f, 0.5f, 0.25f});
	const float Turn =
	    bAlike ? 360.0f : FindStep(Table.Horizontal, {90.0f, 45.0f, 30.0f, 22.5f, 15.0f, 10.0f, 7.5f, 5.0f, 2.5f, 2.0f, 1.0f});
	Out.FirstAngle = Table.Vertical.front();
	Out.RowsPerDegree = 1.0f / Step;
	Out.ColumnsPerDegree = 1.0f / Turn;
	Out.Rows = static_cast<uint32_t>(std::lround((Table.Vertical.back() - Table.Vertical.front()) / Step)) + 1;
	Out.Columns = static_cast<uint32_t>(std::lround(360.0f / Turn));
	Out.Peak = *std::max_element(Table.Candela.begin(), Table.Candela.end());
	Out.Texels.reserve(size_t(Out.Rows) * Out.Columns);
	for (uint32_t Column = 0; Column < Out.Columns; ++Column)
	{
		const float Horizontal = bAlike ? Table.Horizontal.front() : Fold(Table.Horizontal, static_cast<float>(Column) * Turn);
		for (uint32_t Row = 0; Row < Out.Rows; ++Row)
		{
			const float Share = Sample(Table, Horizontal, Out.FirstAngle + static_cast<float>(Row) * Step) / Out.Peak;
			Out.Texels.push_back(static_cast<uint16_t>(std::lround(std::clamp(Share, 0.0f, 1.0f) * 65535.0f)));
		}
	}
	return Out;
}

} // namespace Lantern
