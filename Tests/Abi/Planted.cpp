// One interface in several states, each with one change that breaks engines which were compiled with the first.
#include <cstdint>

#define PLANT(Namespace, Type, Members, Calls, Values)                                                                                     \
	namespace Namespace                                                                                                                    \
	{                                                                                                                                      \
	enum class EKind : Type                                                                                                                \
	{                                                                                                                                      \
		Values                                                                                                                             \
	};                                                                                                                                     \
	struct FDesc                                                                                                                           \
	{                                                                                                                                      \
		Members                                                                                                                            \
	};                                                                                                                                     \
	class IThing                                                                                                                           \
	{                                                                                                                                      \
	public:                                                                                                                                \
		Calls                                                                                                                              \
	};                                                                                                                                     \
	}
#define MEMBERS                                                                                                                            \
	float Width;                                                                                                                           \
	uint32_t Count;
#define CALLS                                                                                                                              \
	virtual int Add(const FDesc& Desc) = 0;                                                                                                \
	virtual void Remove(EKind Kind) = 0;
#define VALUES One, Two

PLANT(Original, uint8_t, MEMBERS, CALLS, VALUES)
PLANT(Equal, uint8_t, MEMBERS, CALLS, VALUES)
PLANT(MemberAdded, uint8_t, MEMBERS uint8_t New;, CALLS, VALUES)
PLANT(MembersSwapped, uint8_t, uint32_t Count; float Width;, CALLS, VALUES)
PLANT(MemberRetyped, uint8_t, float Width; int32_t Count;, CALLS, VALUES)
PLANT(ArrayLonger, uint8_t, float Width; uint32_t Count[2];, CALLS, VALUES)
PLANT(CallAdded, uint8_t, MEMBERS, CALLS virtual void Clear() = 0;, VALUES)
PLANT(CallsSwapped, uint8_t, MEMBERS, virtual void Remove(EKind Kind) = 0; virtual int Add(const FDesc& Desc) = 0;, VALUES)
PLANT(ParameterRetyped, uint8_t, MEMBERS, virtual int Add(const FDesc* Desc) = 0; virtual void Remove(EKind Kind) = 0;, VALUES)
PLANT(ResultRetyped, uint8_t, MEMBERS, virtual long Add(const FDesc& Desc) = 0; virtual void Remove(EKind Kind) = 0;, VALUES)
#undef VALUES
#define VALUES Two, One
PLANT(ValuesSwapped, uint8_t, MEMBERS, CALLS, VALUES)
PLANT(EnumWider, uint16_t, MEMBERS, CALLS, VALUES)
