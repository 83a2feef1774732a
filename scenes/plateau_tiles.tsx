<?xml version="1.0" encoding="UTF-8"?>
<tileset version="1.10" tiledversion="1.11.0" name="plateau" tilewidth="16" tileheight="16" tilecount="6" columns="6">
 <image source="plateau.png" width="96" height="16"/>
 <tile id="0" type="full">
  <objectgroup draworder="index">
   <object id="1" x="0" y="0" width="16" height="16"/>
  </objectgroup>
 </tile>
 <tile id="1" type="slope">
  <objectgroup draworder="index">
   <object id="1" x="0" y="0">
    <polygon points="0,16 16,0 16,16"/>
   </object>
  </objectgroup>
 </tile>
 <tile id="2" type="ledge">
  <objectgroup draworder="index">
   <object id="1" x="0" y="8" width="16" height="8"/>
  </objectgroup>
 </tile>
 <tile id="3" type="platform">
  <objectgroup draworder="index">
   <object id="1" x="0" y="0">
    <polyline points="0,0 16,0"/>
   </object>
  </objectgroup>
 </tile>
 <tile id="4" type="spikes">
  <objectgroup draworder="index">
   <object id="1" x="0" y="0">
    <polygon points="0,16 4,4 8,16"/>
   </object>
   <object id="2" x="8" y="0">
    <polygon points="0,16 4,4 8,16"/>
   </object>
  </objectgroup>
 </tile>
 <tile id="5" type="grass"/>
</tileset>
